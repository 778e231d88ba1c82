#pragma once
/// A value of the case that a variant replaces.

#include <string>

#include "cases/input/json.hpp"

namespace gambeson::study {

/// The value knows its line in the study's file.
struct Setting {
  std::string path;
  JsonNode value;
};

}  // namespace gambeson::study
