#include "output/picture_spheres.hpp"

#include <algorithm>
#include <cmath>

#include "base/array.hpp"
#include "base/parallel.hpp"

namespace gannet {

namespace {

constexpr int band_rows = 32;
constexpr float outside = -1e30F;  ///< depth of the corners of the disc's square

/// What every sphere looks like: a square of (2 reach + 1)^2 pixels about its middle.
struct Disc {
  int reach = 0;
  std::vector<int> half_width;  ///< of each row
  std::vector<float> relief;    ///< depth above that of the middle
  std::vector<float> brightnesses;

  [[nodiscard]] std::size_t at(int across, int down) const {
    return static_cast<std::size_t>(down + reach) * static_cast<std::size_t>(2 * reach + 1) +
           static_cast<std::size_t>(across + reach);
  }
};

Disc disc_of(double radius) {
  const double r = std::max(radius, 0.5);
  Disc disc;
  disc.reach = static_cast<int>(std::floor(r));
  const auto side = static_cast<std::size_t>(2 * disc.reach + 1);
  disc.relief.assign(side * side, outside);
  disc.brightnesses.assign(side * side, 0);
  for (int down = -disc.reach; down <= disc.reach; ++down) {
    disc.half_width.push_back(static_cast<int>(std::floor(std::sqrt(r * r - down * down))));
    for (int across = -disc.half_width.back(); across <= disc.half_width.back(); ++across) {
      const double relief = std::sqrt(std::max(0.0, r * r - down * down - across * across));
      disc.relief[disc.at(across, down)] = static_cast<float>(relief);
      disc.brightnesses[disc.at(across, down)] =
          brightness(static_cast<float>(across / r), static_cast<float>(-down / r),
                     static_cast<float>(relief / r));
    }
  }
  return disc;
}

/// A sphere's middle, as a pixel.
struct Middle {
  int column = 0;
  int row = 0;
};

Middle middle_of(const Sphere& sphere) {
  return {static_cast<int>(std::floor(sphere.column)), static_cast<int>(std::floor(sphere.row))};
}

/// Numbers of the spheres that touch each band of rows, in their order.
struct Bands {
  std::vector<Index> begin;  ///< of each band in `spheres`, and the end of the last
  std::vector<Index> spheres;
};

Bands bands_of(const Canvas& canvas, std::span<const Sphere> spheres, int reach) {
  const int n_bands = (canvas.image.height + band_rows - 1) / band_rows;
  const auto for_each_band = [&](const Sphere& sphere, auto&& f) {
    // Far outside, and NaN, would not fit into an int.
    if (!(std::abs(sphere.column) < 1e6F && std::abs(sphere.row) < 1e6F)) return;
    const Middle m = middle_of(sphere);
    if (m.column + reach < 0 || m.column - reach >= canvas.image.width) return;
    const int top = std::max(m.row - reach, 0);
    const int bottom = std::min(m.row + reach, canvas.image.height - 1);
    if (top > bottom) return;
    for (int band = top / band_rows; band <= bottom / band_rows; ++band) {
      f(static_cast<std::size_t>(band));
    }
  };
  Bands bands;
  bands.begin.assign(static_cast<std::size_t>(n_bands) + 1, 0);
  for (const Sphere& s : spheres) for_each_band(s, [&](std::size_t b) { ++bands.begin[b + 1]; });
  for (std::size_t b = 1; b < bands.begin.size(); ++b) bands.begin[b] += bands.begin[b - 1];
  bands.spheres.resize(static_cast<std::size_t>(bands.begin.back()));
  std::vector<Index> next(bands.begin.begin(), bands.begin.end() - 1);
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for_each_band(spheres[i], [&](std::size_t b) {
      bands.spheres[static_cast<std::size_t>(next[b]++)] = static_cast<Index>(i);
    });
  }
  return bands;
}

/// Sets depth and owner of the pixels of one row of a disc where it is the nearest.
void cover_row(float* depth, Index* owner, const float* relief, int n, float middle, Index self) {
  for (int k = 0; k < n; ++k) {
    const float d = middle + relief[k];
    const bool nearer = d > depth[k];
    depth[k] = nearer ? d : depth[k];
    owner[k] = nearer ? self : owner[k];
  }
}

/// First and last + 1 row of a band.
struct Rows {
  int begin = 0;
  int end = 0;
};

void cover(Canvas& canvas, std::vector<Index>& owners, const Disc& disc, Rows rows,
           std::span<const Sphere> spheres, Index self) {
  const Sphere& sphere = spheres[static_cast<std::size_t>(self)];
  const Middle m = middle_of(sphere);
  const int last = std::min(rows.end - 1, m.row + disc.reach);
  for (int row = std::max(rows.begin, m.row - disc.reach); row <= last; ++row) {
    const int half = disc.half_width[static_cast<std::size_t>(row - m.row + disc.reach)];
    const int left = std::max(0, m.column - half);
    const int right = std::min(canvas.image.width - 1, m.column + half);
    if (left > right) continue;
    const std::size_t to = canvas.image.at(left, row);
    cover_row(&canvas.depth[to], &owners[canvas.image.at(left, row - rows.begin)],
              &disc.relief[disc.at(left - m.column, row - m.row)], right - left + 1, sphere.depth,
              self);
  }
}

void colour_owned(Canvas& canvas, const std::vector<Index>& owners, const Disc& disc, Rows rows,
                  std::span<const Sphere> spheres) {
  for (int row = rows.begin; row < rows.end; ++row) {
    for (int column = 0; column < canvas.image.width; ++column) {
      const Index owner = owners[canvas.image.at(column, row - rows.begin)];
      if (owner < 0) continue;
      const Sphere& sphere = spheres[static_cast<std::size_t>(owner)];
      const Middle m = middle_of(sphere);
      canvas.image.pixels[canvas.image.at(column, row)] =
          shaded(sphere.colour, disc.brightnesses[disc.at(column - m.column, row - m.row)]);
    }
  }
}

}  // namespace

float brightness(float right, float up, float toward) {
  // (-0.4, 0.6, 0.7) made a unit vector.
  const float along = -0.398F * right + 0.597F * up + 0.697F * toward;
  return 0.55F + 0.5F * std::max(0.0F, along);
}

void draw_spheres(Canvas& canvas, std::span<const Sphere> spheres, double radius) {
  const Disc disc = disc_of(radius);
  const Bands bands = bands_of(canvas, spheres, disc.reach);
  parallel_for(static_cast<Index>(bands.begin.size()) - 1, 1, [&](Index band, Index /*end*/) {
    const Rows rows{band * band_rows, std::min((band + 1) * band_rows, canvas.image.height)};
    std::vector<Index> owners(canvas.image.at(0, rows.end - rows.begin), -1);
    const Index end = bands.begin[static_cast<std::size_t>(band) + 1];
    for (Index k = bands.begin[static_cast<std::size_t>(band)]; k < end; ++k) {
      cover(canvas, owners, disc, rows, spheres, bands.spheres[static_cast<std::size_t>(k)]);
    }
    colour_owned(canvas, owners, disc, rows, spheres);
  });
}

}  // namespace gannet
