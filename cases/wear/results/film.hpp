#pragma once
/// Pictures and films of recorded results, as `gambeson render` asks for them: from anywhere, of any part of the
/// motion, of several runs beside each other.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "cases/runs/picture.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

struct FilmRequest {
  std::vector<std::filesystem::path> results;        ///< one to four, beside each other
  std::filesystem::path output;                      ///< .png: one picture; .mp4, .webm, .gif: a film
  PictureCase picture;                               ///< its time is that of a picture alone
  std::optional<double> azimuth_deg, elevation_deg;  ///< in place of those of the view
  double zoom = 1;                                   ///< how much larger than what frames the garments
  bool follow = false;                               ///< the pelvis keeps its place in the film
  std::optional<std::array<double, 2>> range;        ///< of the colours, in the unit of their bar
  std::optional<double> from_s, to_s;                ///< else the whole motion
  std::optional<double> fps;  ///< else as recorded, thinned evenly to at most kUsualFps frames a second
};
inline constexpr double kUsualFps = 30;

namespace schema {

Object filmTable();  ///< the numbers of a FilmRequest

}  // namespace schema

/// "36 frames from -0.5 to 0.2 s".
std::string framesText(const RecordingReader& recording);

/// Draws and writes it. Each frame of a film shows the recorded frame that is nearest to its time, none in between.
/// Colours, the scale of arrows, the camera and the size of what is shown are the same in all frames and for all runs;
/// the camera stands still, or goes along with the pelvis. Returns the exit status. Throws InputError where the request
/// does not fit the recordings.
int renderFilm(const FilmRequest& request);

}  // namespace gambeson
