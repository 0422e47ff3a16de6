// Aligned arrays, index ranges and the 32-byte node line: the memory that everything lives in.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace gannet {

using Index = std::int32_t;

/// Half-open range [begin, end) of entries of a table.
struct Range {
  Index begin = 0;
  Index end = 0;
  [[nodiscard]] Index size() const { return end - begin; }
  [[nodiscard]] bool empty() const { return end <= begin; }
  [[nodiscard]] bool contains(Index i) const { return i >= begin && i < end; }
  friend bool operator==(const Range&, const Range&) = default;
};

/// Bytes that all arrays of the program hold at the moment, counted as they are allocated.
inline std::atomic<std::int64_t> bytes_in_arrays{0};

/// Allocates on cache-line boundaries, so that vector loads of whole blocks are aligned.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  CacheLineAllocator() = default;
  template <class U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) {}
  [[nodiscard]] T* allocate(std::size_t n) {
    T* p = static_cast<T*>(::operator new(n * sizeof(T), alignment));
    bytes_in_arrays += static_cast<std::int64_t>(n * sizeof(T));
    return p;
  }
  void deallocate(T* p, std::size_t n) {
    bytes_in_arrays -= static_cast<std::int64_t>(n * sizeof(T));
    ::operator delete(p, alignment);
  }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

template <class T>
using Array = std::vector<T, CacheLineAllocator<T>>;

/// Four doubles that are loaded and stored as one vector: three components and one companion
/// scalar (the mass beside a position, its inverse beside a velocity).
struct alignas(32) Line {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
};

}  // namespace gannet
