#include "input/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "input/language.hpp"
#include "input/nearest.hpp"

namespace gannet {

namespace {

namespace fs = std::filesystem;

std::string text_of_card(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// As a person would name it: relative to where the program was started, if it lies below.
std::string shown(const fs::path& file) {
  const fs::path relative = file.lexically_proximate(fs::current_path());
  const bool outside = relative.empty() || *relative.begin() == "..";
  return (outside ? file : relative).string();
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

/// Names of all cards that can be found.
std::vector<std::string> known_cards(const std::vector<std::string>& folders) {
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const fs::path& file = entry.path();
      if (file.extension() != ".yaml" || !entry.is_regular_file()) continue;
      if (text_of_card(file).find("gannet_card:") == std::string::npos) continue;
      names.insert(file.stem().string());
    }
  }
  return {names.begin(), names.end()};
}

fs::path find_card(const std::string& name, const std::vector<std::string>& folders) {
  if (!is_plain_name(name)) return {};
  for (const std::string& folder : folders) {
    const fs::path file = fs::path(folder) / (name + ".yaml");
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

/// The card as text, without its version line; `broken` where it is no card.
TextNode read_card(const fs::path& file, Mistakes& mistakes) {
  TextNode card = read_yaml(text_of_card(file), shown(file), mistakes);
  if (card.broken) return card;
  const bool first = card.form == TextNode::Form::map && card.items.front().key == "gannet_card";
  if (!first || card.items.front().text != std::to_string(card_version)) {
    const Location where = first ? card.items.front().where : card.where;
    mistakes.add(where, fmt::format("gannet_card: the first line of a card must be 'gannet_card: "
                                    "{}', which is the version that this program reads",
                                    card_version));
    card.broken = true;
    return card;
  }
  card.items.erase(card.items.begin());
  return card;
}

/// Adds the entries of `card` that `material` does not have; maps are merged.
void add_entries(TextNode& material, const TextNode& card) {
  // Entries are compared with what the case gives, so that a key that stands twice in a card is
  // still seen as such.
  const TextNode given = material;
  for (const TextNode& entry : card.items) {
    if (find(given, entry.key) == nullptr) {
      material.items.push_back(entry);
      continue;
    }
    TextNode* mine = find(material, entry.key);
    const bool maps = mine->form == TextNode::Form::map && entry.form == TextNode::Form::map;
    if (maps) add_entries(*mine, entry);
  }
}

void merge_card(TextNode& material, const std::vector<std::string>& folders, Mistakes& mistakes) {
  const TextNode* name = find(material, "card");
  if (name == nullptr || name->form != TextNode::Form::scalar) return;
  const fs::path file = find_card(name->text, folders);
  if (file.empty()) {
    const std::vector<std::string> known = known_cards(folders);
    mistakes.add(name->where,
                 fmt::format("materials.{}.card: no card '{}'{} (cards: {})", material.key,
                             name->text, did_you_mean(name->text, known), comma_list(known)));
    material.broken = true;
    return;
  }
  const TextNode card = read_card(file, mistakes);
  material.broken = card.broken;
  if (!card.broken) add_entries(material, card);
}

}  // namespace

std::vector<std::string> card_folders(const std::string& case_folder) {
  const fs::path start = fs::absolute(case_folder).lexically_normal();
  std::vector<std::string> folders{start.string()};
  for (fs::path folder = start; folder != folder.root_path(); folder = folder.parent_path()) {
    folders.push_back((folder / "materials").string());
  }
  if (const char* own = std::getenv("GANNET_MATERIALS")) {
    if (*own != '\0') folders.push_back(fs::absolute(own).string());
  }
  folders.emplace_back(GANNET_MATERIALS_FOLDER);
  return folders;
}

void merge_cards(TextNode& root, const std::string& case_folder, Mistakes& mistakes) {
  TextNode* materials = find(root, "materials");
  if (materials == nullptr || materials->form != TextNode::Form::map) return;
  const std::vector<std::string> folders = card_folders(case_folder);
  for (TextNode& material : materials->items) {
    if (material.form == TextNode::Form::map) merge_card(material, folders, mistakes);
  }
}

}  // namespace gannet
