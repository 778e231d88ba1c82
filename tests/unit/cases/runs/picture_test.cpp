#include "cases/runs/picture.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

/// Both sides as the case names them; one alone keeps the usual shape; none is the usual.
TEST(PictureSizes, GoByWhatTheCaseNames) {
  PictureCase picture;
  const auto sizes = [&](PictureSize usual) {
    const PictureSize size = sizeOf(picture, usual);
    return std::pair(size.width, size.height);
  };
  EXPECT_EQ(sizes(kUpright), std::pair(960, 1280));
  EXPECT_EQ(sizes({}), std::pair(1280, 960));
  picture.width = 300;
  EXPECT_EQ(sizes(kUpright), std::pair(300, 400));
  picture.height = 100;
  EXPECT_EQ(sizes(kUpright), std::pair(300, 100));
  picture.width = {};
  EXPECT_EQ(sizes(kUpright), std::pair(75, 100));
}

}  // namespace
}  // namespace gambeson
