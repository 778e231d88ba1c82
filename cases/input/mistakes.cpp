#include "cases/input/mistakes.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace gambeson {

std::vector<InputError> mistakesOf(const InputError& error) {
  const auto* several = dynamic_cast<const InputErrors*>(&error);
  return several ? several->all() : std::vector{error};
}

void Mistakes::add(const InputError& error) {
  for (const InputError& one : mistakesOf(error)) all_.push_back(one);
}

void Mistakes::say() const {
  if (all_.empty()) return;
  std::map<std::string, std::size_t> files;  // by their first mistake
  for (const InputError& e : all_) files.try_emplace(e.where().file, files.size());
  std::vector<InputError> sorted = all_;
  const auto place = [&](const InputError& e) { return std::pair(files.at(e.where().file), e.where().line); };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const InputError& a, const InputError& b) { return place(a) < place(b); });
  throw InputErrors(std::move(sorted));
}

}  // namespace gambeson
