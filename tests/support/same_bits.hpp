// Everything that a simulation holds and shows, as bytes, to compare runs that must be the same.
#pragma once

#include <catch2/catch.hpp>
#include <cstddef>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/simulation.hpp"
#include "time/guards.hpp"
#include "time/step.hpp"

namespace gannet::test {

/// Bytes by name: "x", "panel.stress", "ledger pool kinetic".
using Bits = std::map<std::string, std::vector<std::byte>>;

inline void add_bytes(std::vector<std::byte>& bytes, const void* data, std::size_t n) {
  const auto* first = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), first, first + n);
}

template <class T>
void add_value(std::vector<std::byte>& bytes, const T& value) {
  add_bytes(bytes, &value, sizeof value);
}

/// The entries of a field in their order in memory, ghosts too, without padding. What is made for
/// output alone is made first.
inline std::vector<std::byte> bytes_in(const Field& f) {
  if (f.prepare) f.prepare();
  std::vector<std::byte> bytes;
  const std::size_t size = static_cast<std::size_t>(size_of(f.type));
  bytes.reserve(size * static_cast<std::size_t>(f.count()) *
                static_cast<std::size_t>(f.components));
  for (Index e = 0; e < f.count(); ++e) {
    for (int c = 0; c < f.components; ++c) add_bytes(bytes, f.at(e, c), size);
  }
  return bytes;
}

/// All tracked fields, also those that checkpoints leave out; lists, ledger and clocks.
inline Bits bits_of(const Simulation& s) {
  Bits bits;
  for (const Field& f : s.scene.fields) {
    const auto p = static_cast<std::size_t>(std::max(f.part, 0));
    const std::string of = f.part < 0 ? "" : " of " + s.scene.parts[p].name;
    const bool is_new = bits.emplace("field " + f.name + of, bytes_in(f)).second;
    REQUIRE(is_new);
  }
  for (const IndexList& list : s.scene.index_lists) {
    auto& bytes = bits["list " + list.name];
    for (const Index k : *list.list) add_value(bytes, k);
  }
  for (const LedgerEntry& e : s.models.ledger.entries()) {
    auto& bytes = bits["ledger " + e.part + " " + e.name];
    add_value(bytes, e.value);
    add_value(bytes, e.pending);
  }
  for (const Model& m : s.models.list) {
    auto& bytes = bits["clock of " + m.name];
    add_value(bytes, m.step.n);
    for (const double time : {m.step.t, m.step.dt_old, m.step.dt, m.vote.dt, m.target}) {
      add_value(bytes, time);
    }
    add_value(bytes, m.substeps_left);
  }
  return bits;
}

inline std::size_t n_bytes(const Bits& bits) {
  std::size_t n = 0;
  for (const auto& [name, bytes] : bits) n += bytes.size();
  return n;
}

/// Checks that b is a, byte by byte.
inline void check_same(const Bits& a, const Bits& b) {
  CHECK(a.size() == b.size());
  for (const auto& [name, bytes] : a) {
    INFO(name);
    REQUIRE(b.contains(name));
    const auto& other = b.at(name);
    REQUIRE(other.size() == bytes.size());
    std::size_t first = 0;
    while (first < bytes.size() && bytes[first] == other[first]) ++first;
    INFO("byte " << first << " of " << bytes.size());
    CHECK(first == bytes.size());
  }
}

/// A simulation that writes down, at the end of look of every step (of the slowest model), all that
/// a history may hold: the time, every entry of the ledger and the energy balance; and every
/// measure, but only at each `measures_every`th step, because some take long.
struct WatchedRun {
  std::unique_ptr<Simulation> s;
  std::map<std::int64_t, std::vector<double>> history;  ///< by number of the step
  std::int64_t measures_every = 25;

  WatchedRun(const std::string& file, const std::vector<std::string>& set)
      : s(make_simulation(file, set)) {
    watch();
  }
  explicit WatchedRun(const std::string& text) : s(make_simulation_of_text(text)) { watch(); }
  WatchedRun(const WatchedRun&) = delete;
  WatchedRun& operator=(const WatchedRun&) = delete;

  [[nodiscard]] const Step& at() const { return s->models.list.front().step; }

  void steps(std::int64_t n) {
    for (std::int64_t k = 0; k < n; ++k) advance(s->models);
  }

  /// Steps until a measure is above 0; returns the number of steps made so far.
  std::int64_t until_above_zero(const std::string& measure) {
    double value = 0;
    while (value <= 0) {
      REQUIRE(at().n < 20000);
      advance(s->models);
      for (const Measure& m : s->scene.measures) {
        if (m.name == measure) m.sample(&value);
      }
    }
    return at().n;
  }

 private:
  void watch() {
    s->models.list.back().plan.add({.name = "watch",
                                    .reason = "rule: this test",
                                    .stage = Stage::look,
                                    .run = [this](const Step& step) {
                                      if (step.coincides) write_down(at());
                                    }});
  }
  void add_measures(std::vector<double>& row) {
    for (const Measure& m : s->scene.measures) {
      const std::size_t first = row.size();
      row.resize(first + m.components.size());
      m.sample(row.data() + first);
    }
  }
  void write_down(const Step& step) {
    std::vector<double>& row = history[step.n];
    row = {step.t, step.dt_old, step.dt};
    if (step.n % measures_every == 0) add_measures(row);
    for (const LedgerEntry& e : s->models.ledger.entries()) row.push_back(e.value);
    row.push_back(s->models.ledger.held());
    row.push_back(s->models.ledger.external());
    row.push_back(s->scene.store.get<GuardState>().balance.error());
  }
};

/// Checks that the rows of b are those of a, bit by bit, as far as b has them.
inline void check_same_history(const WatchedRun& a, const WatchedRun& b) {
  REQUIRE(!b.history.empty());
  std::int64_t first = -1;
  std::size_t column = 0;
  for (const auto& [n, row] : b.history) {
    const auto it = a.history.find(n);
    REQUIRE(it != a.history.end());
    REQUIRE(it->second.size() == row.size());
    if (std::memcmp(it->second.data(), row.data(), row.size() * sizeof(double)) != 0) {
      first = n;
      while (std::memcmp(&it->second[column], &row[column], sizeof(double)) == 0) ++column;
      break;
    }
  }
  INFO("first step with another number: " << first << ", number " << column);
  CHECK(first == -1);
}

}  // namespace gannet::test
