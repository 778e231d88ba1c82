#pragma once
/// One function out of several, for std::visit.

namespace gambeson {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace gambeson
