#pragma once
/// Rules between the parts of a case, and the defaults that depend on other fields.

#include "cases/input/schema.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson::schema {

/// `root` is the entry of the whole case; throws InputError at the field that breaks a rule.
void applyRules(const Entry& root, Case& c);

}  // namespace gambeson::schema
