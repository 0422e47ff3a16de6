#include "fe/moordyn_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>

namespace gannet {

namespace {

using Words = std::vector<std::string>;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Words words_of(const std::string& line) {
  std::istringstream in(line);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// One row of a table, by the names of its columns.
struct Row {
  int line = 0;
  std::map<std::string, std::string> cell;
};

/// A point of the file.
struct Point {
  Vec3 at = Vec3::Zero();
  bool coupled = false;
};

/// The kind of line type, for any number of lines.
struct LineType {
  double diameter = 0, mass = 0, EA = 0, damping = 0;
  LineWater water;
};

/// The file as it is read, section by section.
class Reader {
 public:
  Reader(const std::string& text, const std::string& name, bool held) : name_(name), held_(held) {
    split(text);
  }

  MoorDynFile read() {
    read_options();
    for (const Row& row : tables_["types"]) read_type(row);
    for (const Row& row : tables_["points"]) read_point(row);
    if (!(depth_ > 0)) {
      for (const auto& [id, point] : points_) depth_ = std::max(depth_, -point.at.z());
    }
    for (const Row& row : tables_["lines"]) read_line(row);
    for (const char* section : {"bodies", "rods"}) {
      if (!tables_[section].empty())
        wrong(tables_[section][0].line, fmt::format("{} are not supported", section));
    }
    if (out_.lines.empty() && out_.mistakes.empty()) wrong(1, "there are no lines in it");
    if (!out_.mistakes.empty()) out_.lines.clear();
    return std::move(out_);
  }

 private:
  void wrong(int line, const std::string& text) {
    out_.mistakes.push_back(fmt::format("{}:{}: {}", name_, line, text));
  }

  /// The section that a line of dashes names; empty: one that says nothing about lines.
  static std::string section_of(const std::string& title) {
    const std::string t = lower(title);
    const auto has = [&](const char* word) { return t.find(word) != std::string::npos; };
    if (has("line types") || has("line dictionary")) return "types";
    if (has("rod types")) return "";
    if (has("rod")) return "rods";
    if (has("bodies") || has("body")) return "bodies";
    if (has("point") || has("connection") || has("node")) return "points";
    if (has("option")) return "options";
    if (has("lines") || has("line prop")) return "lines";
    return "";
  }

  void split(const std::string& text) {
    std::istringstream in(text);
    std::string section;
    Words columns;
    int head = 0;  // lines of column names and units that are still to come
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      if (line.rfind("---", 0) == 0) {
        section = section_of(line);
        head = section == "options" ? 0 : 2;
        continue;
      }
      const Words words = words_of(line);
      if (section.empty() || words.empty() || words[0][0] == '#') continue;
      if (head == 2) columns = words;
      if (head-- > 0) continue;
      Row row;
      row.line = number;
      if (section == "options") {
        if (words.size() > 1) row.cell = {{lower(words[1]), words[0]}};
      } else {
        for (std::size_t k = 0; k < std::min(words.size(), columns.size()); ++k) {
          row.cell[lower(columns[k])] = words[k];
        }
      }
      tables_[section].push_back(row);
    }
  }

  /// The first of these columns that the row has; nullptr: none.
  static const std::string* find(const Row& row, std::initializer_list<const char*> names) {
    for (const char* name : names) {
      const auto it = row.cell.find(name);
      if (it != row.cell.end()) return &it->second;
    }
    return nullptr;
  }

  double number(const Row& row, std::initializer_list<const char*> names, double otherwise,
                bool wanted = true) {
    const std::string* text = find(row, names);
    if (text == nullptr) {
      if (wanted) wrong(row.line, fmt::format("there is no column '{}'", *names.begin()));
      return otherwise;
    }
    char* end = nullptr;
    const double value = std::strtod(text->c_str(), &end);
    if (end != text->c_str() && *end == 0) return value;
    wrong(row.line, fmt::format("'{}' is not a number ({})", *text, *names.begin()));
    return otherwise;
  }

  std::string word(const Row& row, std::initializer_list<const char*> names) {
    const std::string* text = find(row, names);
    if (text != nullptr) return *text;
    wrong(row.line, fmt::format("there is no column '{}'", *names.begin()));
    return "";
  }

  void read_options() {
    for (const Row& row : tables_["options"]) {
      const auto take = [&](std::initializer_list<const char*> names, double& value) {
        if (find(row, names) != nullptr) value = number(row, names, value);
      };
      take({"g", "gravity"}, out_.g);
      take({"rhow", "wtrdens", "rho"}, rho_);
      take({"wtrdpth", "depth"}, depth_);
      take({"kbot", "kb"}, k_);
      take({"cbot", "cb"}, c_);
      take({"frictioncoefficient", "friccoeff"}, friction_);
    }
  }

  void read_type(const Row& row) {
    LineType type;
    type.diameter = number(row, {"diam", "d"}, 1);
    type.mass = number(row, {"massden", "mass/m", "massdeninair", "mass/length", "mass/l"}, 1);
    type.EA = number(row, {"ea"}, 1);
    type.damping = number(row, {"ba/-zeta", "ba", "ba/-z"}, 0);
    if (!(type.EA > 0)) wrong(row.line, "an axial stiffness (EA) above 0 is wanted");
    if (!(type.mass > 0)) wrong(row.line, "a mass per length above 0 is wanted");
    if (!(type.diameter > 0)) wrong(row.line, "a diameter above 0 is wanted");
    const double EI = number(row, {"ei"}, 0, false);
    if (EI != 0) wrong(row.line, "bending stiffness (EI) is not supported: 0 is wanted");
    type.water.Cdn = number(row, {"cdn", "cd"}, 0);
    type.water.Can = number(row, {"can", "ca"}, 0);
    type.water.Cdt = number(row, {"cdt", "cdax"}, 0);
    type.water.Cat = number(row, {"cat", "caax"}, 0);
    types_[word(row, {"name", "typename", "linetype", "type"})] = type;
  }

  void read_point(const Row& row) {
    Point point;
    const std::string type = lower(word(row, {"type", "attachment"}));
    point.coupled = type == "vessel" || type == "coupled" || type == "cpld";
    if (!point.coupled && type != "fixed" && type != "fix" && type != "anchor") {
      wrong(row.line, fmt::format("points of the kind '{}' are not supported: Fixed, Coupled or "
                                  "Vessel is wanted",
                                  type));
    }
    point.at = {number(row, {"x"}, 0), number(row, {"y"}, 0), number(row, {"z"}, 0)};
    points_[word(row, {"id", "node", "point", "#"})] = point;
  }

  void read_line(const Row& row) {
    const std::string id = word(row, {"id", "line", "#"});
    const auto type = types_.find(word(row, {"linetype", "type"}));
    const auto a = points_.find(word(row, {"attacha", "nodeanch", "nodea", "pointa"}));
    const auto b = points_.find(word(row, {"attachb", "nodefair", "nodeb", "pointb"}));
    if (type == types_.end() || a == points_.end() || b == points_.end()) {
      wrong(row.line, fmt::format("line {} has a type or a point that is not there", id));
      return;
    }
    MooringLine line;
    line.name = "line_" + id;
    line.length = number(row, {"unstrlen", "len"}, 1);
    line.n = static_cast<int>(number(row, {"numsegs", "segs"}, 2));
    if (!(line.length > 0) || line.n < 2) {
      wrong(row.line, fmt::format("line {} wants a length above 0 and two segments or more", id));
      return;
    }
    const bool turned = a->second.coupled && !b->second.coupled;
    line.ends[0].at = (turned ? b : a)->second.at;
    line.ends[1].at = (turned ? a : b)->second.at;
    line.ends[0].held = !(turned ? b : a)->second.coupled || held_;
    line.ends[1].held = !(turned ? a : b)->second.coupled || held_;
    set_section(line, type->second);
    out_.lines.push_back(std::move(line));
  }

  void set_section(MooringLine& line, const LineType& type) const {
    line.diameter = type.diameter;
    line.block.EA = type.EA;
    line.block.mu = type.mass;
    line.block.tension_only = true;
    line.block.unstretched = line.length / line.n;
    // BA is a force per rate of strain: beta EA; below 0 it is the ratio -zeta.
    line.block.damping_ratio = type.damping < 0 ? -type.damping : 0;
    line.block.damping_time = type.damping > 0 ? type.damping / type.EA : 0;
    line.water = type.water;
    line.water.density = rho_;
    line.bed = {
        .there = true, .level = -depth_, .stiffness = k_, .damping = c_, .friction = friction_};
  }

  std::string name_;
  bool held_ = true;  // ends at coupled points
  std::map<std::string, std::vector<Row>> tables_;
  std::map<std::string, LineType> types_;
  std::map<std::string, Point> points_;
  double rho_ = 1025, depth_ = 0, k_ = 3e6, c_ = 3e5, friction_ = 0;
  MoorDynFile out_;
};

}  // namespace

MoorDynFile read_moordyn(const std::string& text, const std::string& name, bool held) {
  return Reader(text, name, held).read();
}

}  // namespace gannet
