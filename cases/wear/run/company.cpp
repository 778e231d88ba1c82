#include "cases/wear/run/company.hpp"

#include <algorithm>

namespace gambeson {

Company::Share Company::take(std::size_t bytes) {
  if (all_bytes_ == 0) return {};
  std::unique_lock hold(lock_);
  left_.wait(hold, [&] { return bytes <= free_bytes_ || shares_ == 0; });
  const std::size_t taken = std::min(bytes, free_bytes_);
  free_bytes_ -= taken;
  ++shares_;
  return {*this, taken};
}

Company::Share::~Share() {
  if (!of_) return;
  {
    const std::lock_guard hold(of_->lock_);
    of_->free_bytes_ += bytes_;
    --of_->shares_;
  }
  of_->left_.notify_all();
}

}  // namespace gambeson
