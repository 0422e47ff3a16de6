#include "output/picture.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/parallel.hpp"
#include "output/picture_cut.hpp"
#include "output/picture_faces.hpp"
#include "output/picture_legend.hpp"
#include "output/picture_spheres.hpp"

namespace gannet {

namespace {

constexpr int oversampling = 2;
constexpr Rgb paper{255, 255, 255};
constexpr Rgb plain_particle{92, 142, 186};
constexpr Rgb plain_face{226, 228, 233};
constexpr Rgb edge_colour{110, 112, 120};
constexpr double narrowest_face = 4;  ///< pixels of the picture; edges of others only blacken it

/// All that the drawing of one frame needs.
struct Drawing {
  const DrawnFrame& frame;
  const PictureSetup& setup;
  const PictureOptions& options;
  Camera camera;
  Ticks ticks;
  PointTest shows;
};

Rgb colour_of(const Drawing& d, double value) {
  const Span span = d.ticks.span;
  return colour_at((value - span.low) / (span.high - span.low));
}

void draw_particles(Canvas& canvas, const Drawing& d, const DrawnPart& part, double radius) {
  const bool coloured = d.setup.colours_particles && !part.values.empty();
  std::vector<Sphere> spheres(part.points.size());
  parallel_for(static_cast<Index>(spheres.size()), node_chunk, [&](Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      const Vec3 at = project(d.camera, part.points[i]);
      spheres[i] = {static_cast<float>(at.x()), static_cast<float>(at.y()),
                    static_cast<float>(at.z()),
                    coloured ? colour_of(d, part.values[i]) : plain_particle};
    }
  });
  if (d.shows.cut) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      if (d.shows(part.points[i])) spheres[n++] = spheres[i];
    }
    spheres.resize(n);
  }
  draw_spheres(canvas, spheres, radius * d.camera.scale);
}

/// A piece of a part, ready to be drawn.
struct Projected {
  std::vector<Vec3> corners;
  double depth = 0;  ///< of the middle
  Rgb colour;
};

Rgb piece_colour(const Drawing& d, const DrawnPart& part, const Projected& piece, Index cell) {
  const bool coloured = !d.setup.colours_particles && !part.values.empty();
  const Rgb own = coloured ? colour_of(d, part.values[static_cast<std::size_t>(cell)]) : plain_face;
  const auto& c = piece.corners;
  if (c.size() < 3) return coloured ? own : edge_colour;
  // Rows run downwards, so up is -y.
  Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  if (normal.z() < 0) normal = -normal;
  return shaded(own, brightness(static_cast<float>(normal.x()), static_cast<float>(-normal.y()),
                                static_cast<float>(normal.z())));
}

/// Pieces of all parts of elements, the furthest first, so that see-through faces mix rightly.
std::vector<Projected> pieces_of(const Drawing& d) {
  std::vector<Projected> pieces;
  for (const DrawnPart& part : d.frame.parts) {
    for (const DrawnPart::Piece& piece : part.pieces) {
      Projected p;
      Vec3 middle = Vec3::Zero();
      for (const Index corner : piece.corners) {
        const Vec3& x = part.points[static_cast<std::size_t>(corner)];
        middle += x / static_cast<double>(piece.corners.size());
        p.corners.push_back(project(d.camera, x));
      }
      if (!d.shows(middle)) continue;
      p.depth = project(d.camera, middle).z();
      p.colour = piece_colour(d, part, p, piece.cell);
      pieces.push_back(std::move(p));
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Projected& a, const Projected& b) { return a.depth < b.depth; });
  return pieces;
}

void draw_faces(Canvas& canvas, const std::vector<Projected>& pieces, double opacity) {
  for (const Projected& p : pieces) {
    for (std::size_t k = 2; k < p.corners.size(); ++k) {
      draw_triangle(canvas, {p.corners[0], p.corners[k - 1], p.corners[k]}, {p.colour, opacity});
    }
  }
}

/// How narrow a piece looks: its area on the picture over its longest side.
double width_of(const std::vector<Vec3>& corners) {
  double area = 0;
  double longest = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[(k + 1) % corners.size()];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
    longest = std::max(longest, (b - a).head<2>().norm());
  }
  return longest > 0 ? std::abs(area) / longest : 0;
}

void draw_edges(Canvas& canvas, const std::vector<Projected>& pieces, double pixel) {
  // In front of the face that they belong to, by more than its slope changes over their width.
  const Vec3 lift(0, 0, 1.5 * pixel);
  for (const Projected& p : pieces) {
    const std::size_t n = p.corners.size();
    if (n == 2) draw_edge(canvas, p.corners[0], p.corners[1], 3 * pixel, {p.colour, 1});
    if (n > 2 && width_of(p.corners) < narrowest_face * pixel) continue;
    for (std::size_t k = 0; n > 2 && k < n; ++k) {
      const Vec3& a = p.corners[k];
      const Vec3& b = p.corners[(k + 1) % n];
      draw_edge(canvas, a + lift, b + lift, 0.8 * pixel, {edge_colour, 1});
    }
  }
}

Camera enlarged(Camera camera, double factor) {
  camera.scale *= factor;
  camera.origin_column *= factor;
  camera.origin_row *= factor;
  return camera;
}

}  // namespace

Raster draw_picture(const DrawnFrame& frame, const PictureSetup& setup, const Shown& shown,
                    const PictureOptions& options) {
  const Area area = scene_area(options.width, options.height);
  Drawing d{.frame = frame,
            .setup = setup,
            .options = options,
            .camera = enlarged(camera_for(setup.view, setup.extent, area), oversampling),
            .ticks = ticks_of(options.range.value_or(setup.values)),
            .shows = test_of(options.cut, setup.view)};
  if (options.range) d.ticks.span = *options.range;
  Canvas canvas(options.width * oversampling, options.height * oversampling, paper);
  for (std::size_t k = 0; k < frame.parts.size(); ++k) {
    const double radius = k < setup.radius.size() ? setup.radius[k] : 0;
    if (frame.parts[k].particles) draw_particles(canvas, d, frame.parts[k], radius);
  }
  const std::vector<Projected> pieces = pieces_of(d);
  if (options.opacity >= 1) draw_faces(canvas, pieces, 1);
  darken_gaps(canvas, 3 * oversampling, 0.9);
  if (options.opacity < 1) draw_faces(canvas, pieces, options.opacity);
  draw_edges(canvas, pieces, oversampling);
  Raster image = shrink(canvas.image, oversampling);
  merge_shades(image);
  draw_title(image, options.title, time_text(frame.t, setup.last_time));
  draw_colour_bar(image, shown.label, shown.unit, d.ticks);
  return image;
}

}  // namespace gannet
