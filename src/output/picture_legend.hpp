// What is written on a picture: title, time and the colour bar.
#pragma once

#include <string>

#include "output/picture_camera.hpp"
#include "output/picture_colours.hpp"
#include "output/picture_image.hpp"

namespace gannet {

/// The part of a picture of this size that the legend leaves to the scene.
Area scene_area(int width, int height);

/// "8.00 ms", in the unit that suits `last` (the time of the last frame) so that it stays the same
/// over all frames; both in seconds.
std::string time_text(double t, double last);

/// A number of the colour bar with the digits that its step needs: 0.5 of steps of 0.5 is "0.5".
std::string tick_text(double value, double step);

/// Title and time at the top left.
void draw_title(Raster& image, const std::string& title, const std::string& time);

/// The colour bar at the right, with a number at each tick and "label [unit]" above it.
void draw_colour_bar(Raster& image, const std::string& label, const std::string& si_unit,
                     const Ticks& ticks);

}  // namespace gannet
