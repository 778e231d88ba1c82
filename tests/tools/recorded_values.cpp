/// Prints a field of a recorded frame as it is: a referee for what pages show.
///
///     recorded_values RESULTS positions|FIELD TIME_S [--body]
///
/// A line of the frame's time, then one of each sample (or vertex of the body) with its numbers.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "core/io/recording.hpp"

int main(int argc, char** argv) {
  CLI::App app("Prints a field of a recorded frame");
  std::string results, name;
  double time_s = 0;
  bool body = false;
  app.add_option("results", results)->required();
  app.add_option("field", name)->required();
  app.add_option("time", time_s)->required();
  app.add_flag("--body", body);
  CLI11_PARSE(app, argc, argv);
  try {
    const gambeson::RecordingReader recording(results);
    int best = 0;
    for (int k = 1; k < recording.frameCount(); ++k)
      if (std::abs(recording.time(k) - time_s) < std::abs(recording.time(best) - time_s)) best = k;
    const gambeson::Frame frame = recording.frame(best);
    fmt::print("{:.9g}\n", frame.time_s);
    const auto print = [](const std::vector<float>& data, std::size_t components) {
      for (std::size_t i = 0; i + components <= data.size(); i += components) {
        for (std::size_t c = 0; c < components; ++c) fmt::print("{}{:.9g}", c > 0 ? " " : "", data[i + c]);
        fmt::print("\n");
      }
    };
    if (name == "positions") {
      print(frame.positions, 3);
      return 0;
    }
    for (const gambeson::Field& f : body ? frame.body_fields : frame.sample_fields)
      if (f.name == name) {
        print(f.data, static_cast<std::size_t>(f.components));
        return 0;
      }
    fmt::print(stderr, "there is no {}\n", name);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
  }
  return 1;
}
