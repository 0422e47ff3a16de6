// Is a text well-formed XML? Enough of the rules for files that the program writes: tags match,
// attributes are quoted, ampersands start entities.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace gannet {

/// "" where it is, else what is wrong.
inline std::string why_not_well_formed(const std::string& text) {
  static const std::regex tag(R"(<(/?)([A-Za-z][\w:-]*)((?:\s+[\w:-]+="[^"<]*")*)\s*(/?)>)",
                              std::regex::optimize);
  static const std::regex entity("&(amp|lt|gt|quot|apos|#[0-9]+);");
  std::vector<std::string> open;
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    if (text.compare(at, 2, "<!") == 0 || text.compare(at, 2, "<?") == 0) continue;
    std::smatch m;
    const std::string rest = text.substr(at, text.find('>', at) - at + 1);
    if (!std::regex_match(rest, m, tag)) return "no tag: " + rest;
    if (m[1].length() > 0) {
      if (open.empty() || open.back() != m[2].str()) return "not open: " + m[2].str();
      open.pop_back();
    } else if (m[4].length() == 0) {
      open.push_back(m[2].str());
    }
  }
  for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
    const std::string rest = text.substr(at, 10);
    if (!std::regex_search(rest, entity, std::regex_constants::match_continuous)) {
      return "no entity: " + rest;
    }
  }
  return open.empty() ? "" : "not closed: " + open.back();
}

}  // namespace gannet
