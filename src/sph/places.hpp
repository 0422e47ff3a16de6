// Points of which none may stand nearer than a distance to another.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/math.hpp"

namespace gannet {

/// Points by cells as large as the distance that they must keep [m].
class Places {
 public:
  explicit Places(double apart) : apart_(apart) {}
  void add(const Vec3& x) { cells_[key(cell(x))].push_back(x); }
  /// Whether no point is nearer to x than that distance.
  [[nodiscard]] bool has_room_at(const Vec3& x) const {
    const std::array<std::int64_t, 3> c = cell(x);
    for (int n = 0; n < 27; ++n) {
      const auto found =
          cells_.find(key({c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1}));
      if (found == cells_.end()) continue;
      for (const Vec3& y : found->second) {
        if ((x - y).norm() < apart_) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> cell(const Vec3& x) const {
    return {std::llround(x.x() / apart_), std::llround(x.y() / apart_),
            std::llround(x.z() / apart_)};
  }
  static std::int64_t key(const std::array<std::int64_t, 3>& c) {
    return ((c[0] & 0x1fffff) << 42) | ((c[1] & 0x1fffff) << 21) | (c[2] & 0x1fffff);
  }
  double apart_;
  std::unordered_map<std::int64_t, std::vector<Vec3>> cells_;
};

}  // namespace gannet
