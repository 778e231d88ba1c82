/// What is said before a disk is full.

#include "cases/wear/recording/recording_size.hpp"
#include "cases/runs/disk_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/wear/recording/recorder.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

const char* sheet = R"({"name": "sheet",
  "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 4, "cells_v": 4}},
  "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "obstacles": [{"name": "floor", "plane": {"point": [0, 0, -1]}}],
  "contact": {"friction": 0.3}, "time": {"duration": 1},
  "output": {"window": "1 ms", "frame": "10 ms", "checkpoint": "100 ms"}})";

RecordingSize sizeOf(const std::string& text) {
  const Folder folder;
  const auto scenario = buildScenario(readCase(folder.write("sheet.json", text)));
  return recordingSize(*scenario, recordingLayout(*scenario));
}

TEST(RecordingSize, CountsWhatTheCaseAsksFor) {
  const RecordingSize few = sizeOf(sheet);
  EXPECT_EQ(few.windows, 1000);
  EXPECT_EQ(few.frames, 101);
  EXPECT_EQ(few.checkpoints, 11);
  const RecordingSize many = sizeOf(replaced(replaced(sheet, "\"1 ms\"", "1e-5"), "\"10 ms\"", "1e-5"));
  EXPECT_EQ(many.windows, 100000);
  EXPECT_NEAR(many.bytes / few.bytes, 500, 500);  // hundred times the windows, thousand times the frames
  EXPECT_GT(many.bytes, 90 * few.bytes);
}

TEST(RecordingSize, IsSaidWhereItIsMuch) {
  EXPECT_EQ(sizeNote(9e9, 1e12), "");
  EXPECT_NE(sizeNote(11e9, 1e12).find("about 11 GB, and 1 TB are free"), std::string::npos) << sizeNote(11e9, 1e12);
  EXPECT_NE(sizeNote(6e8, 1e9).find("about 600 MB"), std::string::npos);
  EXPECT_EQ(sizeNote(9e9, std::nan("")), "");
  EXPECT_NE(sizeNote(2.5e12, std::nan("")).find("about 2.5 TB;"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
