// Pictures of a run's frames, drawn without a display: particles as spheres, elements as faces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/picture_camera.hpp"
#include "output/picture_colours.hpp"
#include "output/picture_data.hpp"
#include "output/picture_image.hpp"

namespace gannet {

/// Everything on the viewer's side of the plane x, y or z = at is left out.
struct Cut {
  int axis = 0;   ///< 0: x, 1: y, 2: z
  double at = 0;  ///< [m]
};

/// "y=0", "z = -0.1": in metres. Throws InputError for anything else.
Cut cut_of(const std::string& text);

struct PictureOptions {
  int width = 1280;   ///< pixels, at least 64
  int height = 720;   ///< pixels, at least 64
  std::string view;   ///< of view_of(); empty: "iso", but "z" where all particles lie in one plane
  std::string title;  ///< shown at the top
  std::optional<Cut> cut;
  std::optional<Span> range;  ///< that the colours run over, SI; without: that of the frames
  double opacity = 1;         ///< of faces, in [0, 1]
};

/// What all pictures of a series share, so that they can be compared and played one after another.
struct PictureSetup {
  View view;
  Extent extent;
  std::vector<double> radius;     ///< of the spheres of each part [m]
  bool colours_particles = true;  ///< the quantity is shown on particles; if not, on elements
  bool has_values = false;
  Span values;
  double last_time = 0;  ///< of the series [s]
};

/// Median distance from a point to its nearest neighbour, of 64 points spread over the list [m];
/// 0 of fewer than two points.
double spacing_of(const std::vector<Vec3>& points);

/// The setup of a series whose first frame this is. Spheres get 0.55 of the particle spacing that
/// the first frame has. The quantity is shown on the particles, or where none has it on elements.
PictureSetup setup_of(const DrawnFrame& first, const PictureOptions& options);

/// Widens extent and values so that this frame fits too. Strays, the 0.2 % of particles that are
/// furthest out at a side, count only up to 15 % beyond the others; the 0.5 % of least and of
/// largest values do not count.
void include_frame(PictureSetup& setup, const DrawnFrame& frame, const PictureOptions& options);

/// Draws a frame: four times the pixels, then means of them; then the legend.
Raster draw_picture(const DrawnFrame& frame, const PictureSetup& setup, const Shown& shown,
                    const PictureOptions& options);

}  // namespace gannet
