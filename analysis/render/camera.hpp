#pragma once
/// The orthographic camera: axes of a view, and the frame that fits the scene into the free part of the picture.

#include "analysis/render/render.hpp"

namespace gambeson {

/// Right-handed: right, up in the picture, towards the viewer.
struct CameraAxes {
  Vec3 right, up, towards;
};
/// From where a picture is taken: `azimuth_deg` turns from the body's front to its left, `elevation_deg` rises from the
/// horizon to `up`. A named view is one.
struct Viewpoint {
  double azimuth_deg = 0, elevation_deg = 0;
  Viewpoint(double azimuth, double elevation) : azimuth_deg(azimuth), elevation_deg(elevation) {}
  Viewpoint(View view);
};
CameraAxes axesOf(const Viewpoint& view, const Vec3& up);

/// A rectangle of the picture in pixels, y downwards.
struct PixelRect {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

/// Camera coordinates c = (right, up, towards) . (x - origin) [m]; `origin` shows at pixel (center_x, center_y).
struct Camera {
  CameraAxes axes;
  Vec3 origin;
  double pixels_per_m = 1;
  double center_x = 0, center_y = 0;

  Vec3 toCamera(const Vec3& x_W) const {
    const Vec3 d = x_W - origin;
    return {dot(axes.right, d), dot(axes.up, d), dot(axes.towards, d)};
  }
  /// Camera coordinates of a pixel at the given depth.
  Vec3 fromPixel(double px, double py, double towards_m) const {
    return {(px - center_x) / pixels_per_m, (center_y - py) / pixels_per_m, towards_m};
  }
};

/// Fits the scene's focus, or every vertex and arrow, into `free` with a margin.
Camera fitCamera(const Scene& scene, const Viewpoint& from, const PixelRect& free);

}  // namespace gambeson
