#include "output/picture_image.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "base/parallel.hpp"
#include "output/files.hpp"

namespace gannet {

namespace {

std::uint8_t byte_of(double v) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(v), 0L, 255L));
}

std::size_t n_pixels(int columns, int rows) {
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

}  // namespace

Rgb mix(Rgb a, Rgb b, double t) {
  return {byte_of(a.r + t * (b.r - a.r)), byte_of(a.g + t * (b.g - a.g)),
          byte_of(a.b + t * (b.b - a.b))};
}

Rgb shaded(Rgb colour, float brightness) {
  const auto part = [brightness](std::uint8_t v) {
    return static_cast<std::uint8_t>(std::min(255.0F, static_cast<float>(v) * brightness + 0.5F));
  };
  return {part(colour.r), part(colour.g), part(colour.b)};
}

Raster::Raster(int columns, int rows, Rgb background)
    : width(columns), height(rows), pixels(n_pixels(columns, rows), background) {}

Canvas::Canvas(int columns, int rows, Rgb background)
    : image(columns, rows, background), depth(n_pixels(columns, rows), nothing) {}

Raster shrink(const Raster& image, int factor) {
  Raster small(image.width / factor, image.height / factor, {});
  const unsigned area = static_cast<unsigned>(factor) * static_cast<unsigned>(factor);
  parallel_for(small.height, 16, [&](Index begin, Index end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < small.width; ++column) {
        unsigned r = area / 2;
        unsigned g = area / 2;
        unsigned b = area / 2;
        for (int k = 0; k < factor * factor; ++k) {
          const Rgb p =
              image.pixels[image.at(column * factor + k % factor, row * factor + k / factor)];
          r += p.r;
          g += p.g;
          b += p.b;
        }
        small.pixels[small.at(column, row)] = {static_cast<std::uint8_t>(r / area),
                                               static_cast<std::uint8_t>(g / area),
                                               static_cast<std::uint8_t>(b / area)};
      }
    }
  });
  return small;
}

void merge_shades(Raster& image) {
  const auto rounded = [](std::uint8_t v) { return static_cast<std::uint8_t>((v + 2) / 5 * 5); };
  for (Rgb& p : image.pixels) p = {rounded(p.r), rounded(p.g), rounded(p.b)};
}

void write_png(const Raster& image, const std::string& path) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  // VTK counts rows from the bottom.
  for (int row = 0; row < image.height; ++row) {
    std::memcpy(data->GetScalarPointer(0, image.height - 1 - row, 0),
                &image.pixels[image.at(0, row)],
                static_cast<std::size_t>(image.width) * sizeof(Rgb));
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(data);
  writer->SetWriteToMemory(1);
  writer->SetCompressionLevel(9);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (writer->GetErrorCode() != 0 || bytes == nullptr) {
    throw std::runtime_error("cannot make the picture " + path);
  }
  write_whole_file(path, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                          static_cast<std::size_t>(bytes->GetNumberOfTuples())});
}

}  // namespace gannet
