#pragma once
/// Loops that a device's compiler lays out whole, so that arrays in them become registers; and functions that it keeps
/// apart, since they are long and rarely called.

#ifdef __CUDACC__
#define GAMBESON_UNROLL _Pragma("unroll")
#define GAMBESON_APART __noinline__
#else
#define GAMBESON_UNROLL
#define GAMBESON_APART
#endif
