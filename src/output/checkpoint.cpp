#include "output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "output/checkpoint_head.hpp"
#include "output/checkpoint_models.hpp"
#include "output/files.hpp"
#include "output/folder.hpp"
#include "output/hdf5_file.hpp"
#include "output/history.hpp"
#include "output/vtk_series.hpp"

namespace gannet {

namespace fs = std::filesystem;

namespace {

using FieldShape = CheckpointHead::FieldShape;

constexpr const char* head_table = "about";

FieldShape shape_of(const Scene& scene, const Field& f) {
  const std::string part = f.part < 0 ? "" : scene.parts[static_cast<std::size_t>(f.part)].name;
  return {f.name, part, f.type, f.components, f.count(), f.checkpoint};
}

std::string key_of(const FieldShape& shape) { return shape.part + "\n" + shape.name; }

std::string title_of(const FieldShape& shape) {
  return shape.part.empty() ? "'" + shape.name + "'"
                            : "'" + shape.name + "' of part '" + shape.part + "'";
}

Hdf5Table table_of(const FieldShape& shape) {
  return {shape.table(), shape.type, shape.count, shape.components};
}

/// Where entry e of a field lies, with the base asked for once.
std::byte* entry_at(std::byte* base, const Layout& l, Index e) {
  return base + (e / l.lanes) * l.block_stride + (e % l.lanes) * l.entry_stride;
}

std::size_t packed_bytes(const Field& f) {
  return static_cast<std::size_t>(f.count()) * static_cast<std::size_t>(f.components) *
         static_cast<std::size_t>(size_of(f.type));
}

/// Calls copy(number in the field, number in the packed table, bytes) for every number.
template <class Copy>
void for_each_number(const Field& f, std::byte* packed, Copy&& copy) {
  std::byte* base = f.base();
  const auto size = static_cast<std::size_t>(size_of(f.type));
  const std::size_t row = size * static_cast<std::size_t>(f.components);
  parallel_for(f.count(), node_chunk, [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      std::byte* at = entry_at(base, f.layout, e);
      for (int c = 0; c < f.components; ++c) {
        copy(at + c * f.layout.component_stride,
             packed + static_cast<std::size_t>(e) * row + static_cast<std::size_t>(c) * size, size);
      }
    }
  });
}

CheckpointHead head_of(const Scene& scene, const Models& models, const RunRecord& record) {
  CheckpointHead head;
  head.version = record.version;
  head.revision = record.revision;
  head.case_file = record.case_file;
  head.case_hash = record.case_hash;
  head.instruction_set = record.instruction_set;
  head.wall_time = record.wall_before + wall_time(record);
  head.cpu_time = record.cpu_before + cpu_time();
  head.n_owned = scene.nodes.n_owned;
  head.n_ghosts = scene.nodes.n_ghosts;
  for (const Field& f : scene.fields) head.fields.push_back(shape_of(scene, f));
  for (const IndexList& l : scene.index_lists) {
    head.lists.push_back({l.name, static_cast<std::int64_t>(l.list->size())});
  }
  for (const Model& m : models.list) {
    head.models.push_back({m.name, m.step, m.vote, m.target, m.substeps_left, m.ranges});
  }
  for (const LedgerEntry& e : models.ledger.entries()) head.ledger.push_back(e);
  head.last_look = record.output.last_look;
  head.strays = record.output.strays;
  head.frames = record.output.frames;
  return head;
}

Hdf5Table list_table(std::size_t k, const CheckpointHead::ListSize& list) {
  return {fmt::format("lists/{}", k), Type::i32, list.size, 1};
}

/// Reading: the file, what it says, and whether mismatches are to be let pass.
struct Reading {
  const std::string& path;
  const CheckpointHead& head;
  bool force = false;
  std::vector<std::string>& warnings;
};

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw InputError(Location{path}, what);
}

void mismatch(const Reading& r, const std::string& what) {
  if (!r.force) {
    refuse(r.path, what + "; give --force to use it all the same");
  }
  r.warnings.push_back(r.path + ": " + what + "; used all the same (--force)");
}

void check_origin(const Reading& r, const RunRecord& record) {
  const CheckpointHead& h = r.head;
  if (h.format != CheckpointHead::format_now) {
    refuse(r.path, fmt::format("the checkpoint has format {}, this program reads format {}",
                               h.format, CheckpointHead::format_now));
  }
  if (h.version != record.version) {
    mismatch(r, fmt::format("the checkpoint was written by gannet {}, this is gannet {}", h.version,
                            record.version));
  } else if (h.revision != record.revision) {
    r.warnings.push_back(fmt::format(
        "{}: the checkpoint was written by revision {}, this is {}: results may differ in the "
        "last bits",
        r.path, h.revision, record.revision));
  }
  if (h.case_hash != record.case_hash) {
    mismatch(r, fmt::format("the checkpoint belongs to another case: it holds {} with hash {}, "
                            "this is {} with hash {}",
                            h.case_file, h.case_hash, record.case_file, record.case_hash));
  }
  if (h.instruction_set != record.instruction_set) {
    r.warnings.push_back(fmt::format(
        "{}: the checkpoint was written with instruction set {}, this run uses {}: results may "
        "differ in the last bits (GANNET_ISA={} chooses the first)",
        r.path, h.instruction_set, record.instruction_set, h.instruction_set));
  }
}

[[noreturn]] void misfit(const Reading& r, const std::string& what) {
  refuse(r.path, "the checkpoint does not fit this case: " + what);
}

void check_field(const Reading& r, const Scene& scene, const Field& f, const FieldShape* stored) {
  const FieldShape here = shape_of(scene, f);
  if (stored == nullptr || !stored->stored) {
    misfit(r, fmt::format("it has no field {}", title_of(here)));
  }
  const bool may_grow = f.resize && f.over != Over::cells;
  if (stored->type != here.type || stored->components != here.components ||
      (stored->count != here.count && !may_grow)) {
    misfit(r, fmt::format("its field {} has {} entries of {} numbers, the case makes {} of {}",
                          title_of(here), stored->count, stored->components, here.count,
                          here.components));
  }
}

std::map<std::string, const FieldShape*> by_key(const CheckpointHead& head) {
  std::map<std::string, const FieldShape*> found;
  for (const FieldShape& f : head.fields) found[key_of(f)] = &f;
  return found;
}

/// All that can be checked before anything is changed.
void check_shapes(const Reading& r, const Scene& scene, const Models& models) {
  if (r.head.n_owned != scene.nodes.n_owned) {
    misfit(r,
           fmt::format("it has {} nodes, the case makes {}", r.head.n_owned, scene.nodes.n_owned));
  }
  const bool models_fit = same_models(r.head, models);
  auto stored = by_key(r.head);
  for (const Field& f : scene.fields) {
    const std::string key = key_of(shape_of(scene, f));
    const auto it = stored.find(key);
    const bool may_lack = (!models_fit || r.force) && is_of_link(f.name) && it == stored.end();
    if (f.checkpoint && !may_lack) {
      check_field(r, scene, f, it == stored.end() ? nullptr : it->second);
    }
    stored[key] = nullptr;
  }
  for (const auto& [key, shape] : stored) {
    if (shape != nullptr && shape->stored && (models_fit || !is_of_link(shape->name))) {
      misfit(r, fmt::format("it has a field {} that the case does not make", title_of(*shape)));
    }
  }
  bool lists_fit = r.head.lists.size() == scene.index_lists.size();
  for (std::size_t k = 0; lists_fit && k < r.head.lists.size(); ++k) {
    lists_fit = r.head.lists[k].name == scene.index_lists[k].name;
  }
  if (!lists_fit) misfit(r, "it has other lists of particles");
  if (models_fit) return;
  const std::string trouble = trouble_with_models(r.head, scene);
  if (!trouble.empty()) misfit(r, "it has other models, and " + trouble);
  mismatch(r, "the checkpoint has other models than the case");
}

void read_fields(const Hdf5Reader& file, const CheckpointHead& head, Scene& scene) {
  const auto stored = by_key(head);
  std::vector<std::byte> packed;
  for (const Field& f : scene.fields) {
    const auto it = stored.find(key_of(shape_of(scene, f)));
    if (it == stored.end()) continue;
    const FieldShape& shape = *it->second;
    if (f.resize && f.count() != shape.count) f.resize(static_cast<Index>(shape.count));
    if (!f.checkpoint) continue;
    packed.resize(packed_bytes(f));
    file.read(table_of(shape), packed.data());
    for_each_number(f, packed.data(), [](std::byte* in_field, std::byte* in_table, std::size_t n) {
      std::memcpy(in_field, in_table, n);
    });
  }
  for (std::size_t k = 0; k < head.lists.size(); ++k) {
    Array<Index>& list = *scene.index_lists[k].list;
    list.resize(static_cast<std::size_t>(head.lists[k].size));
    file.read(list_table(k, head.lists[k]), list.data());
  }
}

void take_models(const CheckpointHead& head, Scene& scene, Models& models) {
  for (const LedgerEntry& e : head.ledger) {
    if (is_state_of_another(e, models.ledger)) continue;
    models.ledger.entry(e.name, e.part) = e;
  }
  if (!same_models(head, models)) return take_other_models(head, scene, models);
  for (std::size_t k = 0; k < head.models.size(); ++k) {
    Model& m = models.list[k];
    m.step = head.models[k].step;
    m.vote = head.models[k].vote;
    m.target = head.models[k].target;
    m.substeps_left = head.models[k].substeps_left;
  }
}

[[noreturn]] void damaged(const std::string& path, const std::string& why) {
  std::string message = "the checkpoint is damaged or cut off: " + why;
  const std::string folder = fs::path(path).parent_path().string();
  for (const long long number : checkpoints_in(folder.empty() ? "." : folder)) {
    const fs::path other = checkpoint_path(folder.empty() ? "." : folder, number);
    if (other.filename() != fs::path(path).filename()) {
      message += "; " + other.string() + " is there too";
    }
  }
  refuse(path, message);
}

}  // namespace

void write_checkpoint(const std::string& path, const Scene& scene, const Models& models,
                      const RunRecord& record) {
  const CheckpointHead head = head_of(scene, models, record);
  const std::string temporary = temporary_beside(path);
  {
    Hdf5Writer file(temporary);
    file.write_text(head_table, to_text(head));
    std::vector<std::byte> packed;
    for (std::size_t k = 0; k < scene.fields.size(); ++k) {
      const Field& f = scene.fields[k];
      if (!f.checkpoint) continue;
      packed.resize(packed_bytes(f));
      for_each_number(f, packed.data(),
                      [](std::byte* in_field, std::byte* in_table, std::size_t n) {
                        std::memcpy(in_table, in_field, n);
                      });
      file.write(table_of(head.fields[k]), packed.data());
    }
    for (std::size_t k = 0; k < head.lists.size(); ++k) {
      file.write(list_table(k, head.lists[k]), scene.index_lists[k].list->data());
    }
    file.close();
  }
  rename_whole_file(temporary, path, Durable::yes);
}

std::string write_next_checkpoint(const Scene& scene, const Models& models, RunRecord& record) {
  for (const std::string& path : record.output.not_on_disk) bring_to_disk(path);
  record.output.not_on_disk.clear();
  const fs::path history = fs::path(record.folder) / "history";
  if (fs::is_directory(history)) {
    for (const auto& entry : fs::directory_iterator(history)) bring_to_disk(entry.path().string());
  }
  const long long number = models.list.back().step.n;
  std::string path = checkpoint_path(record.folder, number);
  write_checkpoint(path, scene, models, record);
  record.last_checkpoint = RunRecord::Clock::now();
  record.last_checkpoint_t = models.list.front().step.t;

  // Kept: this one and the last before it. Later ones belong to a run that this one replaced.
  std::vector<long long> others = checkpoints_in(record.folder);
  std::erase(others, number);
  const auto later = std::upper_bound(others.begin(), others.end(), number);
  if (later != others.begin()) others.erase(later - 1);
  for (const long long n : others) fs::remove(checkpoint_path(record.folder, n));
  return path;
}

bool checkpoint_due(const Models& models, const RunRecord& record) {
  if (record.folder.empty()) return false;
  const CheckpointEvery& every = record.plan.checkpoint;
  if (every.wall_interval > 0) {
    const auto since = RunRecord::Clock::now() - record.last_checkpoint;
    return std::chrono::duration<double>(since).count() >= every.wall_interval;
  }
  return due({every.interval}, record.last_checkpoint_t, models.list.front().step.t);
}

std::vector<std::string> read_checkpoint(const std::string& path, Scene& scene, Models& models,
                                         RunRecord& record, bool force) {
  if (!fs::is_regular_file(path)) refuse(path, "there is no such checkpoint");
  std::vector<std::string> warnings;
  try {
    const Hdf5Reader file(path);
    const CheckpointHead head = head_from_text(file.read_text(head_table));
    const Reading reading{path, head, force, warnings};
    check_origin(reading, record);
    check_shapes(reading, scene, models);
    scene.nodes.n_ghosts = head.n_ghosts;
    read_fields(file, head, scene);
    take_models(head, scene, models);
    record.output.last_look = head.last_look;
    record.output.frames = head.frames;
    record.output.finished = head.last_look >= record.plan.until;
    record.wall_before = head.wall_time;
    record.cpu_before = head.cpu_time;
  } catch (const DamagedFile& error) {
    damaged(path, error.what());
  }
  for (const auto& rebuild : scene.after_restart) rebuild();
  return warnings;
}

void rewind_output(const Models& models, RunRecord& record) {
  cut_histories(record.folder, models.list.front().step.t);
  rewind_frames(record);
}

}  // namespace gannet
