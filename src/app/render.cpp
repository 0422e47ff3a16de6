#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/commands.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "output/picture.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

/// "1280x720" into width and height.
void read_size(const std::string& text, PictureOptions& picture) {
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%dx%d%c", &picture.width, &picture.height, &rest);
  const auto fits = [](int pixels) { return pixels >= 64 && pixels <= 8192; };
  if (n != 2 || !fits(picture.width) || !fits(picture.height)) {
    throw InputError({"--size " + text + ": must be WIDTHxHEIGHT in pixels, 64 to 8192 each"});
  }
}

/// "0:12" into a span, SI.
Span range_of(const std::string& text) {
  Span span;
  char rest = 0;
  const int n = std::sscanf(text.c_str(), "%lf:%lf%c", &span.low, &span.high, &rest);
  if (n != 2 || !(span.low < span.high) || !std::isfinite(span.high - span.low)) {
    throw InputError({"--range " + text + ": must be LOW:HIGH in SI units, LOW below HIGH"});
  }
  return span;
}

std::size_t frame_number(const Series& series, const std::string& text) {
  const std::size_t n = series.frames.size();
  if (text == "last") return n - 1;
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number >= n) {
    throw InputError(
        {fmt::format("--frame {}: must be last, or a number in [0, {}]", text, n - 1)});
  }
  return number;
}

PictureOptions picture_of(const RenderOptions& options, const Series& series) {
  PictureOptions picture;
  read_size(options.size, picture);
  picture.view = options.view;
  picture.title = options.title.empty() ? series.name : options.title;
  picture.opacity = options.opacity;
  if (!options.cut.empty()) picture.cut = cut_of(options.cut);
  if (!options.range.empty()) picture.range = range_of(options.range);
  return picture;
}

std::string file_of(const RenderOptions& options, const Series& series, std::size_t number) {
  const std::string name = fmt::format("{}_{:06}.png", series.name, number);
  if (!options.all) return options.out.empty() ? name : options.out;
  return (fs::path(options.out.empty() ? series.name + "_pictures" : options.out) / name).string();
}

}  // namespace

int render_command(const RenderOptions& options) {
  set_threads(options.threads);
  const Series series = read_series(options.folder);
  const PictureOptions picture = picture_of(options, series);
  const Shown shown = shown_quantity(options.colour);
  std::vector<std::size_t> numbers;
  if (options.all) {
    for (std::size_t k = 0; k < series.frames.size(); ++k) numbers.push_back(k);
  } else {
    numbers.push_back(frame_number(series, options.frame));
  }
  const auto read = [&](std::size_t k) { return read_frame(series, series.frames[k], shown); };
  PictureSetup setup = setup_of(read(0), picture);
  setup.last_time = series.frames.back().t;
  const auto draw = [&](const DrawnFrame& frame, std::size_t k) {
    const std::string file = file_of(options, series, k);
    write_png(draw_picture(frame, setup, shown, picture), file);
    fmt::print("{}\n", file);
  };
  if (!options.all) {
    const DrawnFrame frame = read(numbers.front());
    include_frame(setup, frame, picture);
    draw(frame, numbers.front());
    return 0;
  }
  // Read twice rather than kept: all frames of a long run would not fit into memory.
  fs::create_directories(fs::path(file_of(options, series, 0)).parent_path());
  for (const std::size_t k : numbers) include_frame(setup, read(k), picture);
  for (const std::size_t k : numbers) draw(read(k), k);
  return 0;
}

}  // namespace gannet
