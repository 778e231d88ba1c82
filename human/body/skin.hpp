#pragma once
/// A closed skin around a skeleton: core/contact/skin.hpp, whose links are those of the skeleton.

#include "core/contact/skin.hpp"
#include "human/skeleton/skeleton.hpp"
