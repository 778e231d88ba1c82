/// Tables for spreadsheets with a decimal comma.

#include <gtest/gtest.h>

#include "core/io/csv.hpp"
#include "core/io/csv_text.hpp"

namespace gambeson {
namespace {

TEST(EuropeanCsv, NumbersHaveCommasAndCellsSemicolons) {
  const std::string table = formatCsv({"time_s", "torque_Nm"}, {{0.01, -1.5e-9}, {2, 1e300}});
  EXPECT_EQ(europeanCsv(table), "time_s;torque_Nm\n0,01;-1,5e-09\n2;1e+300\n");
}

TEST(EuropeanCsv, TextsStayWhatTheyAre) {
  const std::string table =
      formatCsv("variant", {"0.5 mm, thin", "a;b \"c\"", "=1+2", "1.2.3"}, {"v1.0"}, {{1.5}, {2.5}, {3}, {4}});
  EXPECT_EQ(europeanCsv(table), "variant;v1.0\n0.5 mm, thin;1,5\n\"a;b \"\"c\"\"\";2,5\n'=1+2;3\n1.2.3;4\n");
}

TEST(EuropeanCsv, EmptyCellsAndLinesStay) {
  EXPECT_EQ(europeanCsv("a,,b\n,1.5,\n"), "a;;b\n;1,5;\n");
  EXPECT_EQ(europeanCsv(""), "");
  EXPECT_EQ(europeanCsv("\"two\nlines\",nan\n"), "\"two\nlines\";nan\n");
}

}  // namespace
}  // namespace gambeson
