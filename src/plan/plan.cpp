#include "plan/plan.hpp"

#include <cassert>

#include "plan/effect.hpp"

namespace gannet {

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::force:
      return "force";
    case Stage::accelerate:
      return "accelerate";
    case Stage::kick:
      return "kick";
    case Stage::look:
      return "look";
    case Stage::half_drift:
      return "half drift";
    case Stage::rates:
      return "rates";
    case Stage::drift:
      return "drift";
  }
  return "";
}

LedgerEntry& Ledger::entry(const std::string& name, const std::string& part) {
  for (LedgerEntry& e : entries_) {
    if (e.name == name && e.part == part) return e;
  }
  entries_.push_back({name, part});
  return entries_.back();
}

double Ledger::held() const {
  double sum = 0;
  for (const LedgerEntry& e : entries_) {
    if (!e.external && !e.within_other) sum += e.value;
  }
  return sum;
}

double Ledger::external() const {
  double sum = 0;
  for (const LedgerEntry& e : entries_) {
    if (e.external && !e.within_other) sum += e.value;
  }
  return sum;
}

std::string Vote::limited_by() const {
  if (by == nullptr) return who;
  return by->limited_by ? by->limited_by() : by->name;
}

Operation& Plan::add(Operation operation) {
  auto& stage = at(operation.stage);
  stage.push_back(std::move(operation));
  return stage.back();
}

Operation& Plan::add_first(Operation operation) {
  auto& stage = at(operation.stage);
  stage.push_front(std::move(operation));
  return stage.front();
}

std::size_t Models::rank(const Model& model) const {
  std::size_t place = 0;
  while (place < list.size() && &list[place] != &model) ++place;
  return place;
}

Model& Models::of_node(Index node) {
  for (Model& m : list) {
    for (const Range& r : m.ranges) {
      if (r.contains(node)) return m;
    }
  }
  assert(!list.empty());
  return list.front();
}

std::string asked_for_at(const Location& where) { return "asked for at " + where.text(); }

}  // namespace gannet
