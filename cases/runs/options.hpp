#pragma once
/// What the command asks of a run of whatever kind, and of its results.

#include <filesystem>

#include "cases/runs/picture.hpp"
#include "core/device_kind.hpp"

namespace gambeson {

class Company;  // cases/wear/run/company.hpp

struct RunOptions {
  std::filesystem::path out;  ///< results folder
  int threads = 0;            ///< 0: OMP_NUM_THREADS, or as many as the machine has
  bool resume = false;        ///< continue what an interrupted run left in `out`
  DeviceKind device = DeviceKind::cpu;
  bool names_gpu = false;      ///< says where a GPU could have done it
  Company* company = nullptr;  ///< of other runs whose steps this process makes too
};

struct RenderOptions {
  std::filesystem::path results;  ///< folder of a run
  std::filesystem::path png;
  PictureField field = PictureField::stress;
  PictureTime when = PictureTime::end;
  double time_s = 0;  ///< where `when` is `at`
  View view = View::front_right;
  int width = 1280, height = 960;
};

struct ReportOptions {
  std::filesystem::path results;
  std::filesystem::path html;
};

}  // namespace gambeson
