#include "input/cards.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "small_language.hpp"

using namespace gannet;
using namespace gannet::test;

namespace {

namespace fs = std::filesystem;

/// A folder of cards beside a case, removed when the test ends.
struct Library {
  fs::path folder = fs::temp_directory_path() / "gannet_test_cards";
  std::string file = (folder / "cases" / "case.yaml").string();
  Library() {
    fs::remove_all(folder);
    fs::create_directories(folder / "materials");
    fs::create_directories(folder / "cases");
    card("metal_x",
         "gannet_card: 1\nname: Metal X\nsource: [a book, a table]\ndensity: 2.7 g/cm^3\n"
         "young: 70 GPa\npoisson: 0.33\n");
  }
  ~Library() { fs::remove_all(folder); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  void card(const std::string& name, const std::string& text) const {
    std::ofstream(folder / "materials" / (name + ".yaml")) << text;
  }
  [[nodiscard]] std::string mistakes(const std::string& material) const {
    return mistakes_in("gannet: 1\nmaterials: {skin: " + material + "}\n", {}, file);
  }
  [[nodiscard]] std::string place(const std::string& name) const {
    return (folder / "materials" / (name + ".yaml")).string();
  }
};

}  // namespace

TEST_CASE("card: its keys act as if they stood in the case, and keys beside it win", "[input]") {
  const Library library;
  const auto c =
      read("gannet: 1\nmaterials: {skin: {card: metal_x, young: 71 GPa}}\n", {}, library.file);
  const Keys skin = c->keys().map("materials").map("skin");
  CHECK(skin.number("density") == 2700);
  CHECK(skin.number("young") == 71e9);
  CHECK(skin.number("poisson") == 0.33);
  CHECK(skin.word("name") == "Metal X");
  CHECK(skin.words("source") == std::vector<std::string>{"a book", "a table"});
  CHECK(skin.where("density").text() == library.place("metal_x") + ":4:10");
  CHECK(skin.where("young").text() == library.file + ":2:42");
}

TEST_CASE("card: an override wins over the card", "[input]") {
  const Library library;
  const auto c = read("gannet: 1\nmaterials: {skin: {card: metal_x}}\n",
                      {"materials.skin.poisson=0.3"}, library.file);
  CHECK(c->keys().map("materials").map("skin").number("poisson") == 0.3);
}

TEST_CASE("card: the hash follows the numbers of the card", "[input]") {
  const Library library;
  const std::string text = "gannet: 1\nmaterials: {skin: {card: metal_x}}\n";
  const auto before = read(text, {}, library.file)->hash;
  library.card("metal_x",
               "gannet_card: 1\nname: Metal X\nsource: [a book, a table]\n"
               "density: 2710\nyoung: 70 GPa\npoisson: 0.33\n");
  CHECK(read(text, {}, library.file)->hash != before);
}

TEST_CASE("card: an unknown one lists those that exist", "[input]") {
  const Library library;
  const std::string text = library.mistakes("{card: metal_y}");
  CHECK(text.find(library.file + ":2:26: materials.skin.card: no card 'metal_y'; did you mean "
                                 "'metal_x'? (cards: ") == 0);
  CHECK(text.find("metal_x") != std::string::npos);
  CHECK(text.find('\n') == std::string::npos);
  CHECK(library.mistakes("{card: ../cases/case}").find("no card '../cases/case'") !=
        std::string::npos);
}

TEST_CASE("card: mistakes within a card are placed there", "[input]") {
  const Library library;
  library.card("bad", "gannet_card: 1\ndensity: 3 m\ncolour: red\n");
  const std::string text = library.mistakes("{card: bad}");
  CHECK(text.find(library.place("bad") + ":2:10: materials.skin.density: '3 m' is a length; a "
                                         "density is wanted (kg/m^3, g/cm^3, ...)\n") == 0);
  CHECK(text.find(library.place("bad") + ":3:1: materials.skin.colour: unknown key; ") !=
        std::string::npos);
  library.card("twice", "gannet_card: 1\ndensity: 1\ndensity: 2\n");
  CHECK(library.mistakes("{card: twice}") ==
        library.place("twice") +
            ":3:1: materials.skin.density: duplicate key; it stands at line 2 already");
  library.card("old", "gannet_card: 7\n");
  CHECK(library.mistakes("{card: old}") ==
        library.place("old") +
            ":1:14: gannet_card: the first line of a card must be 'gannet_card: "
            "1', which is the version that this program reads");
  library.card("empty", "");
  CHECK(library.mistakes("{card: empty}").find(library.place("empty") + ":1:1: gannet_card: ") ==
        0);
  library.card("broken", "gannet_card: 1\na: [\n");
  CHECK(library.mistakes("{card: broken}").find(": this is not YAML: ") != std::string::npos);
}

TEST_CASE("card: folders are searched from the case outwards", "[input]") {
  const std::vector<std::string> folders = card_folders("/a/b");
  REQUIRE(folders.size() >= 4);
  CHECK(folders[0] == "/a/b");
  CHECK(folders[1] == "/a/b/materials");
  CHECK(folders[2] == "/a/materials");
}
