/// Faults of a device that tests provoke, and what is said of each.

#include "gpu/device/fault_switch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "gpu/device/gpu.hpp"
#include "gpu/finding/impact_search.hpp"

namespace gambeson::gpu {
namespace {

TEST(FaultSwitch, ReadsFaultStepAndFolder) {
  EXPECT_FALSE(faultSwitch(""));
  const auto lost = faultSwitch("device_lost@120@thick");
  EXPECT_EQ(lost->fault, DeviceFault::device_lost);
  EXPECT_EQ(lost->step, 120);
  EXPECT_EQ(lost->folder, "thick");
  EXPECT_FALSE(lost->before());
  EXPECT_TRUE(faultSwitch("little_memory")->before());
  EXPECT_TRUE(faultSwitch("not_built")->before());
  EXPECT_FALSE(faultSwitch("kernel_limit@3")->before());
  EXPECT_EQ(faultSwitch("kernel_limit@3")->step, 3);
  for (const char* wrong :
       {"lost", "device_lost@", "device_lost@0", "device_lost@-1", "device_lost@3x", "device_lost@@a"})
    EXPECT_THROW(faultSwitch(wrong), RunError) << wrong;
}

TEST(FaultSwitch, OfOneFolderAlone) {
  setenv("GAMBESON_FAULT", "out_of_memory@5@thick", 1);
  EXPECT_TRUE(faultSwitchFor("thick"));
  EXPECT_FALSE(faultSwitchFor("thin"));
  setenv("GAMBESON_FAULT", "out_of_memory@5", 1);
  EXPECT_TRUE(faultSwitchFor("thin"));
  unsetenv("GAMBESON_FAULT");
  EXPECT_FALSE(faultSwitchFor("thick"));
}

TEST(DeviceFaults, EachSaysWhatItIs) {
  std::vector<std::string> said;
  for (int k = 0; k <= static_cast<int>(DeviceFault::kernel_limit); ++k) {
    const DeviceError e(static_cast<DeviceFault>(k), "what it said");
    EXPECT_NE(std::string(e.what()).find("what it said"), std::string::npos) << e.what();
    said.push_back(e.what());
  }
  std::ranges::sort(said);
  EXPECT_EQ(std::ranges::unique(said).begin(), said.end());
}

TEST(DeviceFaults, AProgramWithoutCudaSaysSo) {
  if (cudaBuilt()) GTEST_SKIP() << "this program has CUDA";
  try {
    findGpu();
    ADD_FAILURE() << "found " << findGpu().name;
  } catch (const DeviceError& e) {
    EXPECT_EQ(e.fault(), DeviceFault::not_built);
    EXPECT_NE(std::string(e.what()).find("GAMBESON_CUDA"), std::string::npos);
  }
  EXPECT_FALSE(gpuName());
}

TEST(DeviceFaults, KernelsHaveAVersion) {
  EXPECT_EQ(kernelsVersion().size(), 12u);
  EXPECT_EQ(kernelsVersion().find_first_not_of("0123456789abcdef"), std::string::npos);
}

}  // namespace
}  // namespace gambeson::gpu
