#pragma once
/// Loops that a device's compiler lays out whole, so that arrays in them become registers.

#ifdef __CUDACC__
#define GAMBESON_UNROLL _Pragma("unroll")
#else
#define GAMBESON_UNROLL
#endif
