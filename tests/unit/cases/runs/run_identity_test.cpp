/// What a recording belongs to, and what goes on from it.

#include "cases/runs/run_identity.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace gambeson {
namespace {

TEST(RunIdentity, TextSaysItAll) {
  const RunIdentity cpu("abc", "avx512", DeviceKind::cpu), reference("abc", "avx512", DeviceKind::reference),
      cuda("abc", "avx512", DeviceKind::cuda);
  EXPECT_EQ(cpu.text(), "abc avx512");  // as recordings had it before there were devices
  EXPECT_EQ(reference, cuda);
  EXPECT_NE(cpu, cuda);
  for (const RunIdentity& i : {cpu, cuda}) {
    EXPECT_EQ(RunIdentity(i.text()), i);
    EXPECT_EQ(RunIdentity(i.text()).case_hash, "abc");
    EXPECT_EQ(RunIdentity(i.text()).kernels, "avx512");
  }
}

TEST(RunIdentity, OtherDevicesAreRefusedByName) {
  const RunIdentity cpu("abc", "avx512", DeviceKind::cpu), device("abc", "avx512", DeviceKind::cuda);
  EXPECT_NO_THROW(requireSameDevice(cpu, DeviceKind::cpu, "out"));
  EXPECT_NO_THROW(requireSameDevice(device, DeviceKind::reference, "out"));
  EXPECT_NO_THROW(requireSameDevice(device, DeviceKind::cuda, "out"));
  const auto reason = [](const RunIdentity& recorded, DeviceKind now) -> std::string {
    try {
      requireSameDevice(recorded, now, "out");
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, "--device");
      return e.reason();
    }
    ADD_FAILURE() << "accepted";
    return "";
  };
  EXPECT_NE(reason(cpu, DeviceKind::cuda).find("out was computed with --device cpu, and --device cuda does not"),
            std::string::npos);
  EXPECT_NE(reason(device, DeviceKind::cpu).find("with --device reference or cuda, and --device cpu does not"),
            std::string::npos);
}

}  // namespace
}  // namespace gambeson
