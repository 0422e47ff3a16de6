#include "contact/surface.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gannet {

namespace {

/// Where segments meet: an edge of a face, an end of a line.
struct Joint {
  std::pair<Index, Index> key;  ///< its nodes in ascending order
  Index segment = 0;
  int number = 0;       ///< of the edge or corner within its segment
  bool forward = true;  ///< neighbours turned the same way run a joint in opposite directions
};

std::vector<Joint> joints_of(const std::vector<Segment>& segments) {
  std::vector<Joint> joints;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Segment& g = segments[s];
    for (int k = 0; k < g.n_corners; ++k) {
      const Index a = g.corner[static_cast<std::size_t>(k)];
      const Index b = g.corner[static_cast<std::size_t>((k + 1) % g.n_corners)];
      const auto number = static_cast<Index>(s);
      if (g.n_corners == 2) {
        joints.push_back({{a, a}, number, k, k == 0});
      } else {
        joints.push_back({{std::min(a, b), std::max(a, b)}, number, k, a < b});
      }
    }
  }
  std::stable_sort(joints.begin(), joints.end(),
                   [](const Joint& a, const Joint& b) { return a.key < b.key; });
  return joints;
}

/// Calls f(first, last) for each group of joints at the same place.
template <class F>
void for_groups(const std::vector<Joint>& joints, F&& f) {
  for (std::size_t i = 0; i < joints.size();) {
    std::size_t j = i;
    while (j < joints.size() && joints[j].key == joints[i].key) ++j;
    f(i, j);
    i = j;
  }
}

/// Neighbours across plain joints (exactly two segments), the rim, and whether the neighbour is
/// turned the other way.
std::vector<std::array<bool, 4>> connect(std::vector<Segment>& segments,
                                         std::vector<std::uint8_t>& at_rim) {
  std::vector<std::array<bool, 4>> opposed(segments.size());
  std::fill(at_rim.begin(), at_rim.end(), std::uint8_t{0});
  for (Segment& g : segments) g.neighbour = {-1, -1, -1, -1};
  const std::vector<Joint> joints = joints_of(segments);
  for_groups(joints, [&](std::size_t i, std::size_t j) {
    const Joint& a = joints[i];
    const Joint& b = joints[j - 1];
    if (j - i != 2 || a.segment == b.segment) {
      at_rim[static_cast<std::size_t>(a.key.first)] = 1;
      at_rim[static_cast<std::size_t>(a.key.second)] = 1;
      return;
    }
    const auto sa = static_cast<std::size_t>(a.segment);
    const auto sb = static_cast<std::size_t>(b.segment);
    const auto ka = static_cast<std::size_t>(a.number);
    const auto kb = static_cast<std::size_t>(b.number);
    segments[sa].neighbour[ka] = b.segment;
    segments[sb].neighbour[kb] = a.segment;
    opposed[sa][ka] = opposed[sb][kb] = a.forward == b.forward;
  });
  return opposed;
}

void turn(Segment& g) {
  std::reverse(g.corner.begin(), g.corner.begin() + g.n_corners);
  for (std::size_t k = static_cast<std::size_t>(g.n_corners); k < 4; ++k) {
    g.corner[k] = g.corner[k - 1];
  }
}

/// Numbers the sheets and turns segments to agree with the first of their sheet.
void turn_alike(Surface& surface) {
  std::vector<Segment>& segments = surface.segments;
  const auto opposed = connect(segments, surface.at_rim);
  std::vector<std::uint8_t> turned(segments.size(), 0);
  std::vector<std::uint8_t> seen(segments.size(), 0);
  Index n_sheets = 0;
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (seen[first] != 0) continue;
    std::vector<std::size_t> open{first};
    seen[first] = 1;
    while (!open.empty()) {
      const std::size_t s = open.back();
      open.pop_back();
      segments[s].sheet = n_sheets;
      for (std::size_t k = 0; k < 4; ++k) {
        if (segments[s].neighbour[k] < 0) continue;
        const auto other = static_cast<std::size_t>(segments[s].neighbour[k]);
        if (seen[other] != 0) continue;
        seen[other] = 1;
        turned[other] = turned[s] ^ static_cast<std::uint8_t>(opposed[s][k]);
        open.push_back(other);
      }
    }
    ++n_sheets;
  }
  for (std::size_t s = 0; s < segments.size(); ++s) {
    if (turned[s] != 0) turn(segments[s]);
  }
  connect(segments, surface.at_rim);
}

Segment segment_of(const Index* node, int n) {
  Segment g;
  g.n_corners = n == 4 && node[3] == node[2] ? 3 : n;
  for (int k = 0; k < 4; ++k) {
    g.corner[static_cast<std::size_t>(k)] = node[std::min(k, g.n_corners - 1)];
  }
  return g;
}

/// Normal of the mean plane; of a line, within the x-y plane.
Vec3 normal_of(const Segment& g, const std::array<Vec3, 4>& p) {
  Vec3 n;
  if (g.n_corners == 2) {
    n = Vec3(p[0].y() - p[1].y(), p[1].x() - p[0].x(), 0);
  } else if (g.n_corners == 3) {
    n = (p[1] - p[0]).cross(p[2] - p[0]);
  } else {
    n = (p[2] - p[0]).cross(p[3] - p[1]);
  }
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

}  // namespace

Surface make_surface(const Part& part) {
  const int n = nodes_per(part.cell);
  assert(n >= 2 && n <= 4 && part.cell != Cell::tetrahedron);
  Surface surface;
  surface.node.assign(part.connectivity.begin(), part.connectivity.end());
  std::sort(surface.node.begin(), surface.node.end());
  surface.node.erase(std::unique(surface.node.begin(), surface.node.end()), surface.node.end());
  surface.cell_id = part.cell_id;
  for (std::size_t i = 0; i < part.connectivity.size(); i += static_cast<std::size_t>(n)) {
    Segment g = segment_of(&part.connectivity[i], n);
    for (Index& c : g.corner) {
      const auto at = std::lower_bound(surface.node.begin(), surface.node.end(), c);
      c = static_cast<Index>(at - surface.node.begin());
    }
    surface.segments.push_back(g);
  }
  surface.at_rim.resize(surface.node.size());
  turn_alike(surface);
  for (const Segment& g : surface.segments) surface.corners.push_back(g.corner);
  surface.x.resize(surface.node.size());
  surface.place.resize(surface.segments.size());
  surface.node_normal.resize(surface.node.size());
  return surface;
}

namespace {

/// Makes a rim around segments whose elements have left since the last look. What comes of it is a
/// function of who has left, not of when.
void open_around_left(Surface& surface) {
  if (surface.gone == nullptr) return;
  surface.left.resize(surface.segments.size(), 0);
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    if ((*surface.gone)[s] == 0 || surface.left[s] != 0) continue;
    surface.left[s] = 1;
    for (const Index other : surface.segments[s].neighbour) {
      if (other < 0) continue;
      for (Index& back : surface.segments[static_cast<std::size_t>(other)].neighbour) {
        if (back == static_cast<Index>(s)) back = -1;
      }
    }
    for (const Index node : surface.segments[s].corner) {
      surface.at_rim[static_cast<std::size_t>(node)] = 1;
    }
  }
}

}  // namespace

void update_surface(const Nodes& nodes, Surface& surface) {
  open_around_left(surface);
  for (std::size_t i = 0; i < surface.node.size(); ++i) {
    surface.x[i] = nodes.x[static_cast<std::size_t>(surface.node[i])];
    surface.node_normal[i].setZero();
  }
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    const Segment& g = surface.segments[s];
    std::array<Vec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      p[k] = xyz(surface.x[static_cast<std::size_t>(g.corner[k])]);
    }
    SegmentPlace& place = surface.place[s];
    place.centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    place.normal = normal_of(g, p);
    double radius2 = 0;
    for (const Vec3& q : p) radius2 = std::max(radius2, (q - place.centre).squaredNorm());
    place.radius = std::sqrt(radius2);
    if (has_left(surface, static_cast<Index>(s))) continue;
    for (int k = 0; k < g.n_corners; ++k) {
      surface.node_normal[static_cast<std::size_t>(g.corner[static_cast<std::size_t>(k)])] +=
          place.normal;
    }
  }
}

Closest closest_on_segment(const Surface& surface, Index segment, const Vec3& x) {
  const Segment& g = surface.segments[static_cast<std::size_t>(segment)];
  Vec3 p[4];
  for (int k = 0; k < 4; ++k) {
    p[k] = xyz(surface.x[static_cast<std::size_t>(g.corner[static_cast<std::size_t>(k)])]);
  }
  if (g.n_corners == 4) return closest_on_quad(x, p);
  if (g.n_corners == 3) return closest_on_triangle(x, p);
  return closest_on_line(x, p[0], p[1]);
}

Vec3 side_normal(const Surface& surface, Index segment, const Closest& closest) {
  const auto s = static_cast<std::size_t>(segment);
  const Segment& g = surface.segments[s];
  const auto k = static_cast<std::size_t>(closest.number);
  if (closest.feature == Feature::corner) {
    return surface.node_normal[static_cast<std::size_t>(g.corner[k])];
  }
  if (closest.feature == Feature::edge && g.neighbour[k] >= 0) {
    return surface.place[s].normal + surface.place[static_cast<std::size_t>(g.neighbour[k])].normal;
  }
  return surface.place[s].normal;
}

bool on_rim(const Surface& surface, Index segment, const Closest& closest) {
  const Segment& g = surface.segments[static_cast<std::size_t>(segment)];
  const auto k = static_cast<std::size_t>(closest.number);
  if (closest.feature == Feature::corner) {
    return surface.at_rim[static_cast<std::size_t>(g.corner[k])] != 0;
  }
  return closest.feature == Feature::edge && g.neighbour[k] < 0;
}

}  // namespace gannet
