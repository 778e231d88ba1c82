#pragma once
/// A share of a population, from a sample of it.

namespace gambeson {

struct ShareInterval {
  double low = 0, high = 1;
};

/// Wilson's score interval of a share p of which `yes` of `of` are seen (E. B. Wilson 1927, J. Am. Stat. Assoc. 22,
/// 209):
///   (k + z^2/2) / (n + z^2) -+ z sqrt(n) / (n + z^2) sqrt(k/n (1 - k/n) + z^2 / 4n),   z = 1.959964 (95 %).
/// Of independent draws; for n = 0 it is [0, 1]. Covers p with about 95 % for all n and p, also where k is 0 or n.
ShareInterval wilsonInterval(int yes, int of);

}  // namespace gambeson
