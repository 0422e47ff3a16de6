#include "mesh/msh_file.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace gannet {
namespace {

using Tag = std::int64_t;

// The first mistake in a file; reading stops there, since what follows cannot be trusted.
struct MshMistake {
  Location where;
  std::string text;
};

// The lines of a file, each split into its words.
class Lines {
 public:
  explicit Lines(const std::string& file) : file_(file), in_(file) {
    if (!in_) throw MshMistake{{file, 0, 0}, "the file cannot be opened"};
  }

  // Moves to the next line that is not empty; false at the end of the file.
  bool next() {
    while (std::getline(in_, line_)) {
      ++number_;
      split();
      if (!words_.empty()) return true;
    }
    return false;
  }

  // The same inside a section, where the file must not end.
  void next_of(std::string_view section) {
    if (!next()) fail(fmt::format("the file ends within ${}", section));
    if (words_[0].starts_with('$')) {
      fail(fmt::format("'{}' comes before all that ${} announces has been given", words_[0],
                       section));
    }
  }

  [[nodiscard]] std::size_t size() const { return words_.size(); }
  [[nodiscard]] std::string_view word(std::size_t k) const { return words_[k]; }
  [[nodiscard]] const std::string& line() const { return line_; }

  [[nodiscard]] Tag integer(std::size_t k) const { return parse<Tag>(k, "a whole number"); }
  [[nodiscard]] Tag count(std::size_t k) const {
    const Tag n = integer(k);
    if (n < 0) fail(fmt::format("'{}' is not a count", words_[k]));
    return n;
  }
  [[nodiscard]] double number(std::size_t k) const {
    const auto value = parse<double>(k, "a number");
    if (!std::isfinite(value)) fail(fmt::format("'{}' is not finite", words_[k]));
    return value;
  }

  [[noreturn]] void fail(const std::string& text) const {
    throw MshMistake{{file_, number_, 0}, text};
  }

 private:
  void split() {
    words_.clear();
    const std::string_view line = line_;
    for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
      words_.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(blanks, end);
    }
  }

  template <class T>
  [[nodiscard]] T parse(std::size_t k, const char* what) const {
    if (k >= words_.size()) {
      fail(fmt::format("{} is missing behind {} word(s)", what, words_.size()));
    }
    T value{};
    const char* end = words_[k].data() + words_[k].size();
    const auto [stop, error] = std::from_chars(words_[k].data(), end, value);
    if (error != std::errc{} || stop != end) {
      fail(fmt::format("'{}' stands where {} is wanted", words_[k], what));
    }
    return value;
  }

  static constexpr const char* blanks = " \t\r";
  std::string file_;
  std::ifstream in_;
  std::string line_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

constexpr std::size_t most_nodes = 8;

// A type of element that is read: its number in the file, its dimension, its nodes.
struct CellType {
  Tag number;
  int dimension;
  std::size_t n;
};
constexpr std::array cell_types = {CellType{1, 1, 2}, CellType{2, 2, 3}, CellType{3, 2, 4},
                                   CellType{4, 3, 4}, CellType{5, 3, 8}};
constexpr std::array types_of_higher_order = {8,  9,  10, 11, 12, 13, 14, 16, 17, 18, 19, 20,
                                              21, 22, 23, 29, 30, 31, 36, 37, 38, 92, 93};
constexpr std::array types_of_other_volumes = {6, 7};  // prisms, pyramids

// What has been read so far.
struct MshContent {
  int dimension = 2;                       // of the cells that are wanted
  int version = 0;                         // 4 or 2; 0 before $MeshFormat
  std::map<std::string, Tag> group_tags;   // physical surfaces, or volumes, by name
  std::map<Tag, std::set<Tag>> groups_of;  // physical surfaces of each surface (4.1), or volumes
  std::unordered_map<Tag, Vec3> nodes;     // [unit of the file]
  std::string wanted_group;                // "" for all
  std::vector<std::array<Tag, most_nodes>> cells;  // node tags
  std::size_t n_nodes = 0;                         // of each volume; surfaces have 4
};

void read_format(Lines& in, MshContent& content) {
  in.next_of("MeshFormat");
  if (in.word(0).starts_with("4.1")) content.version = 4;
  if (in.word(0).starts_with("2.")) content.version = 2;
  if (content.version == 0) {
    in.fail(fmt::format("format {} is not read; save the mesh as 4.1 or 2.2", in.word(0)));
  }
  if (in.integer(1) != 0) in.fail("the file is binary; save the mesh as ASCII");
}

void read_names(Lines& in, MshContent& content) {
  in.next_of("PhysicalNames");
  for (Tag left = in.count(0); left > 0; --left) {
    in.next_of("PhysicalNames");
    const Tag dimension = in.integer(0);
    const Tag tag = in.integer(1);
    const std::size_t open = in.line().find('"');
    const std::size_t close = in.line().rfind('"');
    if (open == std::string::npos || close == open) in.fail("a name in quotes is wanted");
    if (dimension == content.dimension)
      content.group_tags[in.line().substr(open + 1, close - open - 1)] = tag;
  }
}

// The groups of one surface or volume, whose line this is.
void read_groups(const Lines& in, MshContent& content) {
  const Tag n_groups = in.count(7);  // after the tag and the two corners around it
  // gmsh marks a surface that was taken in the other sense by a negative tag of its group.
  for (Tag k = 0; k < n_groups; ++k) {
    content.groups_of[in.integer(0)].insert(std::abs(in.integer(static_cast<std::size_t>(8 + k))));
  }
}

// Points, curves, surfaces and volumes, of which one kind is wanted.
void read_entities(Lines& in, MshContent& content) {
  in.next_of("Entities");
  const std::array<Tag, 4> n = {in.count(0), in.count(1), in.count(2), in.count(3)};
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    for (Tag left = n[dimension]; left > 0; --left) {
      in.next_of("Entities");
      if (static_cast<int>(dimension) == content.dimension) read_groups(in, content);
    }
  }
}

void add_node(Lines& in, MshContent& content, Tag tag, std::size_t first) {
  const Vec3 x(in.number(first), in.number(first + 1), in.number(first + 2));
  if (!content.nodes.emplace(tag, x).second) in.fail(fmt::format("node {} is there twice", tag));
}

void read_nodes(Lines& in, MshContent& content) {
  in.next_of("Nodes");
  if (content.version == 2) {
    for (Tag left = in.count(0); left > 0; --left) {
      in.next_of("Nodes");
      add_node(in, content, in.integer(0), 1);
    }
    return;
  }
  for (Tag blocks = in.count(0); blocks > 0; --blocks) {
    in.next_of("Nodes");
    const Tag n = in.count(3);
    std::vector<Tag> tags;
    for (Tag k = 0; k < n; ++k) {
      in.next_of("Nodes");
      tags.push_back(in.integer(0));
    }
    for (const Tag tag : tags) {
      in.next_of("Nodes");
      add_node(in, content, tag, 0);
    }
  }
}

// The type, if its cells are wanted; fails at what cannot be read.
const CellType* wanted_type(const Lines& in, const MshContent& content, Tag type) {
  for (const int known : types_of_higher_order) {
    if (type == known) {
      in.fail(fmt::format("element type {} is of higher order; mesh with order 1", type));
    }
  }
  for (const int known : types_of_other_volumes) {
    if (type == known && content.dimension == 3) {
      in.fail("prisms and pyramids are not read; mesh with tetrahedra or hexahedra");
    }
  }
  for (const CellType& known : cell_types) {
    if (known.number == type && known.dimension == content.dimension) return &known;
  }
  return nullptr;
}

void check_nodes(const Lines& in, const MshContent& content, const Tag* cell, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    if (!content.nodes.contains(cell[k])) {
      in.fail(fmt::format("element {} uses node {}, which is not there", in.integer(0), cell[k]));
    }
    if (std::find(cell + k + 1, cell + n, cell[k]) != cell + n) {
      in.fail(fmt::format("element {} uses node {} twice", in.integer(0), cell[k]));
    }
  }
}

// Takes the cell on this line, whose node tags begin at word `first`, if it is one that is wanted.
void add_cell(Lines& in, MshContent& content, Tag type, std::size_t first) {
  const CellType* known = wanted_type(in, content, type);
  if (known == nullptr) return;
  const std::size_t n = known->n;
  if (in.size() < first + n) in.fail(fmt::format("the element needs {} nodes", n));
  std::array<Tag, most_nodes> cell{};
  for (std::size_t k = 0; k < n; ++k) cell[k] = in.integer(first + k);
  check_nodes(in, content, cell.data(), n);
  if (n == 3) cell[3] = cell[2];
  if (content.dimension == 3 && content.n_nodes != 0 && content.n_nodes != n) {
    in.fail("tetrahedra and hexahedra stand in one part; take a part for each by its 'group'");
  }
  content.n_nodes = content.dimension == 2 ? 4 : n;
  content.cells.push_back(cell);
}

void read_elements(Lines& in, MshContent& content) {
  const bool all = content.wanted_group.empty();
  const auto group = content.group_tags.find(content.wanted_group);
  const Tag wanted = group == content.group_tags.end() ? -1 : group->second;
  in.next_of("Elements");
  if (content.version == 2) {
    for (Tag left = in.count(0); left > 0; --left) {
      in.next_of("Elements");
      const Tag n_tags = in.count(2);
      if (all || (n_tags > 0 && std::abs(in.integer(3)) == wanted)) {
        add_cell(in, content, in.integer(1), static_cast<std::size_t>(3 + n_tags));
      }
    }
    return;
  }
  for (Tag blocks = in.count(0); blocks > 0; --blocks) {
    in.next_of("Elements");
    const bool of_dimension = in.integer(0) == content.dimension;
    const auto groups = content.groups_of.find(in.integer(1));
    const bool taken =
        of_dimension &&
        (all || (groups != content.groups_of.end() && groups->second.contains(wanted)));
    const Tag type = in.integer(2);
    for (Tag left = in.count(3); left > 0; --left) {
      in.next_of("Elements");
      if (taken) add_cell(in, content, type, 1);
    }
  }
}

void read_sections(Lines& in, MshContent& content) {
  using Section = void (*)(Lines&, MshContent&);
  const std::map<std::string, Section, std::less<>> known = {{"$MeshFormat", read_format},
                                                             {"$PhysicalNames", read_names},
                                                             {"$Entities", read_entities},
                                                             {"$Nodes", read_nodes},
                                                             {"$Elements", read_elements}};
  while (in.next()) {
    const std::string name(in.word(0));
    if (!name.starts_with('$')) in.fail(fmt::format("'{}' stands outside of a section", name));
    const auto section = known.find(name);
    if (name != "$MeshFormat" && content.version == 0) {
      in.fail(fmt::format("'{}' comes before $MeshFormat; is this a gmsh file?", name));
    }
    if (section != known.end()) section->second(in, content);
    const std::string end = "$End" + name.substr(1);
    if (section != known.end() && (!in.next() || in.word(0) != end)) {
      in.fail(fmt::format("{} is wanted here", end));
    }
    while (section == known.end() && in.word(0) != end) {
      if (!in.next()) in.fail(fmt::format("the file ends before {}", end));
    }
  }
  if (content.version == 0) in.fail("the file holds no $MeshFormat; is this a gmsh file?");
}

void check_group(const Lines& in, const MshContent& content) {
  constexpr std::array kinds = {"", "curve", "surface", "volume"};
  constexpr std::array lacks = {"", "no lines", "no quadrilaterals and no triangles",
                                "no tetrahedra and no hexahedra"};
  const auto dimension = static_cast<std::size_t>(content.dimension);
  if (content.cells.empty() && content.wanted_group.empty()) {
    in.fail(fmt::format("the file holds {}", lacks[dimension]));
  }
  if (!content.cells.empty()) return;
  std::string names;
  for (const auto& [name, tag] : content.group_tags) names += (names.empty() ? "" : ", ") + name;
  in.fail(fmt::format("no {0} cell belongs to the group '{1}'; physical {0}s of this file: {2}",
                      kinds[dimension], content.wanted_group, names.empty() ? "none" : names));
}

// The points that cells use, in the order in which these name them, and the cells over them.
void number_points(const MshContent& content, std::vector<Vec3>& points,
                   std::vector<Index>& cells) {
  std::unordered_map<Tag, Index> number;
  for (const auto& cell : content.cells) {
    for (std::size_t k = 0; k < content.n_nodes; ++k) {
      const auto [place, fresh] = number.emplace(cell[k], static_cast<Index>(points.size()));
      if (fresh) points.push_back(content.nodes.at(cell[k]));
      cells.push_back(place->second);
    }
  }
}

// False after a mistake, which is noted.
bool read_content(const std::string& file, MshContent& content, Mistakes& mistakes) {
  try {
    Lines in(file);
    read_sections(in, content);
    check_group(in, content);
  } catch (const MshMistake& mistake) {
    mistakes.add(mistake.where, mistake.text);
    return false;
  }
  return true;
}

}  // namespace

SurfaceMesh read_msh(const std::string& file, const std::string& group, Mistakes& mistakes) {
  MshContent content;
  content.wanted_group = group;
  SurfaceMesh mesh;
  if (read_content(file, content, mistakes)) number_points(content, mesh.points, mesh.quads);
  return mesh;
}

LineMesh read_msh_lines(const std::string& file, const std::string& group, Mistakes& mistakes) {
  MshContent content;
  content.dimension = 1;
  content.wanted_group = group;
  LineMesh mesh;
  if (read_content(file, content, mistakes)) number_points(content, mesh.points, mesh.cells);
  return mesh;
}

VolumeMesh read_msh_volume(const std::string& file, const std::string& group, Mistakes& mistakes) {
  MshContent content;
  content.dimension = 3;
  content.wanted_group = group;
  VolumeMesh mesh;
  if (!read_content(file, content, mistakes)) return mesh;
  number_points(content, mesh.points, mesh.cells);
  mesh.nodes_per_cell = static_cast<int>(content.n_nodes);
  return mesh;
}

}  // namespace gannet
