#include "output/checkpoint_head.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "output/hdf5_file.hpp"

namespace gannet {

namespace {

using Json = nlohmann::json;

std::string exact(double value) { return fmt::format("{}", value); }

double number(const Json& json) { return std::strtod(json.get<std::string>().c_str(), nullptr); }

Json to_json(const CheckpointHead::FieldShape& f) {
  return {{"name", f.name},
          {"part", f.part},
          {"type", static_cast<int>(f.type)},
          {"components", f.components},
          {"count", f.count},
          {"stored", f.stored}};
}

CheckpointHead::FieldShape field_from(const Json& j) {
  return {j.at("name"),       j.at("part"),  static_cast<Type>(j.at("type").get<int>()),
          j.at("components"), j.at("count"), j.at("stored")};
}

Json to_json(const CheckpointHead::ModelState& m) {
  Json ranges = Json::array();
  for (const Range& r : m.ranges) ranges.push_back({r.begin, r.end});
  return {{"name", m.name},
          {"nodes", ranges},
          {"n", m.step.n},
          {"t", exact(m.step.t)},
          {"dt_old", exact(m.step.dt_old)},
          {"dt", exact(m.step.dt)},
          {"coincides", m.step.coincides},
          {"vote", exact(m.vote.dt)},
          {"who", m.vote.limited_by()},
          {"target", exact(m.target)},
          {"substeps_left", m.substeps_left}};
}

CheckpointHead::ModelState model_from(const Json& j) {
  CheckpointHead::ModelState m;
  m.name = j.at("name");
  m.step.n = j.at("n");
  m.step.t = number(j.at("t"));
  m.step.dt_old = number(j.at("dt_old"));
  m.step.dt = number(j.at("dt"));
  m.step.coincides = j.at("coincides");
  m.vote = {number(j.at("vote")), j.at("who")};
  m.target = number(j.at("target"));
  m.substeps_left = j.at("substeps_left");
  // Not there in files of older programs.
  if (!j.contains("nodes")) return m;
  for (const Json& r : j.at("nodes")) m.ranges.push_back({r.at(0), r.at(1)});
  return m;
}

Json to_json(const LedgerEntry& e) {
  return {{"name", e.name},          {"part", e.part},
          {"external", e.external},  {"within_other", e.within_other},
          {"value", exact(e.value)}, {"pending", exact(e.pending)}};
}

LedgerEntry entry_from(const Json& j) {
  LedgerEntry e;
  e.name = j.at("name");
  e.part = j.at("part");
  e.external = j.at("external");
  e.within_other = j.at("within_other");
  e.value = number(j.at("value"));
  e.pending = number(j.at("pending"));
  return e;
}

Json to_json(const Frame& frame) {
  Json files = Json::array();
  for (const Frame::File& f : frame.files) files.push_back({{"part", f.part}, {"path", f.path}});
  return {{"number", frame.number}, {"t", exact(frame.t)}, {"files", files}};
}

Frame frame_from(const Json& j) {
  Frame frame{j.at("number"), number(j.at("t")), {}};
  for (const Json& f : j.at("files")) frame.files.push_back({f.at("part"), f.at("path")});
  return frame;
}

template <class T>
Json list_of(const std::vector<T>& values) {
  Json list = Json::array();
  for (const T& v : values) list.push_back(to_json(v));
  return list;
}

CheckpointHead head_from(const Json& j) {
  CheckpointHead head;
  head.format = j.at("format");
  if (head.format != CheckpointHead::format_now) return head;
  head.version = j.at("version");
  head.revision = j.at("revision");
  head.case_file = j.at("case_file");
  head.case_hash = j.at("case_hash");
  head.instruction_set = j.at("instruction_set");
  head.wall_time = number(j.at("wall_time"));
  // Not there in files of older programs.
  if (j.contains("cpu_time")) head.cpu_time = number(j.at("cpu_time"));
  if (j.contains("deepest_penetration")) head.strays.deepest = number(j.at("deepest_penetration"));
  head.strays.lost = j.value("lost_particles", Index{0});
  head.n_owned = j.at("n_owned");
  head.n_ghosts = j.at("n_ghosts");
  for (const Json& f : j.at("fields")) head.fields.push_back(field_from(f));
  for (const Json& l : j.at("lists")) head.lists.push_back({l.at("name"), l.at("size")});
  for (const Json& m : j.at("models")) head.models.push_back(model_from(m));
  for (const Json& e : j.at("ledger")) head.ledger.push_back(entry_from(e));
  head.last_look = number(j.at("last_look"));
  for (const Json& f : j.at("frames")) head.frames.push_back(frame_from(f));
  return head;
}

}  // namespace

std::string to_text(const CheckpointHead& head) {
  Json lists = Json::array();
  for (const auto& l : head.lists) lists.push_back({{"name", l.name}, {"size", l.size}});
  const Json j = {{"format", head.format},
                  {"version", head.version},
                  {"revision", head.revision},
                  {"case_file", head.case_file},
                  {"case_hash", head.case_hash},
                  {"instruction_set", head.instruction_set},
                  {"wall_time", exact(head.wall_time)},
                  {"cpu_time", exact(head.cpu_time)},
                  {"deepest_penetration", exact(head.strays.deepest)},
                  {"lost_particles", head.strays.lost},
                  {"n_owned", head.n_owned},
                  {"n_ghosts", head.n_ghosts},
                  {"fields", list_of(head.fields)},
                  {"lists", lists},
                  {"models", list_of(head.models)},
                  {"ledger", list_of(head.ledger)},
                  {"last_look", exact(head.last_look)},
                  {"frames", list_of(head.frames)}};
  return j.dump(1);
}

CheckpointHead head_from_text(const std::string& text) {
  try {
    return head_from(Json::parse(text));
  } catch (const Json::exception& error) {
    throw DamagedFile(std::string("its head is not understood: ") + error.what());
  }
}

}  // namespace gannet
