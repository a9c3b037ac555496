#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "common/error.hpp"
#include "common/toml_reader.hpp"

using namespace chute;

namespace {

enum class Colour { red, green };
constexpr std::array<std::string_view, 2> colours{"red", "green"};

struct Wall {
  double height = 2;
  std::vector<double> bricks;
};
struct House {
  std::string name = "hut";
  std::int64_t rooms = 1;
  bool warm = false;
  Colour colour = Colour::green;
  std::optional<double> garden;
  std::vector<std::string> people;
  std::optional<Wall> wall;
};

template <class Archive>
void describe(Archive& a, Wall& wall) {
  a.required("height", wall.height, between(1, 3));
  a.value("bricks", wall.bricks, positive);
}
template <class Archive>
void describe(Archive& a, House& house) {
  a.value("name", house.name);
  a.value("rooms", house.rooms, at_least(1));
  a.value("warm", house.warm);
  a.choice("colour", house.colour, colours);
  a.value("garden", house.garden, non_negative);
  a.value("people", house.people);
  a.section("wall", house.wall);
}

House read(const std::string& text) {
  const auto table = parse_toml(text, "h.toml");
  TomlReader reader(table, "h.toml");
  House house;
  describe(reader, house);
  reader.finish();
  return house;
}
std::string refused(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string set_in(const std::string& text, const std::string& assignment) {
  auto table = parse_toml(text, "h.toml");
  try {
    set_by_path(table, assignment);
  } catch (const InputError& error) {
    return error.what();
  }
  std::ostringstream out;
  out << table;
  return out.str();
}
std::string written(House house) {
  TomlWriter writer;
  describe(writer, house);
  return writer.text();
}

}  // namespace

TEST_CASE("one description reads and writes") {
  const auto house = read(
      "name = \"inn\"\nrooms = 12\nwarm = true\ncolour = \"red\"\ngarden = 3\npeople = [\"a\", \"b\"]\n"
      "[wall]\nheight = 1.5\nbricks = [1, 0.1]\n");
  CHECK(house.name == "inn");
  CHECK(house.rooms == 12);
  CHECK(house.warm);
  CHECK(house.colour == Colour::red);
  CHECK(house.garden == 3.0);
  CHECK(house.people == std::vector<std::string>{"a", "b"});
  REQUIRE(house.wall);
  CHECK(house.wall->bricks == std::vector<double>{1, 0.1});
  CHECK(written(house) ==
        "name = 'inn'\nrooms = 12\nwarm = true\ncolour = 'red'\ngarden = 3.0\npeople = ['a', 'b']\n\n"
        "[wall]\nheight = 1.5\nbricks = [1.0, 0.1]\n");
  CHECK(written(read(written(house))) == written(house));
}

TEST_CASE("what is absent keeps its default, and optional things stay absent") {
  const auto house = read("");
  CHECK(house.name == "hut");
  CHECK_FALSE(house.garden);
  CHECK_FALSE(house.wall);
  CHECK(written(house) == "name = 'hut'\nrooms = 1\nwarm = false\ncolour = 'green'\npeople = []\n");
}

TEST_CASE("texts and numbers survive being written") {
  House house;
  for (const std::string name :
       {"", "it's", "\"quoted\"", "back\\slash", "two\nlines", "tab\t", "\x01", "Größe", "'''"}) {
    house.name = name;
    INFO(written(house));
    CHECK(read(written(house)).name == name);
  }
  for (const double x : {0.1, 1e-300, 5e6, 1e22, 1.0 / 3, 123456789012345.0, 0.0, std::nextafter(1.0, 2.0)}) {
    house.garden = x;
    CHECK(*read(written(house)).garden == x);
  }
}

TEST_CASE("every kind of mistake has its line and its key") {
  CHECK(refused("rooms = 1\nroom = 2") == "h.toml:2: room: unknown key, did you mean rooms?");
  CHECK(refused("rooms = 1\n\nchimneys = 2") ==
        "h.toml:3: chimneys: unknown key, known: name, rooms, warm, colour, garden, people, wall");
  CHECK(refused("rooms = 0") == "h.toml:1: rooms: 0 is not allowed, must be >= 1");
  CHECK(refused("rooms = 1.0") == "h.toml:1: rooms: 1.0 is not a whole number");
  CHECK(refused("warm = 1") == "h.toml:1: warm: 1 is not true or false");
  CHECK(refused("garden = -1") == "h.toml:1: garden: -1 is not allowed, must be >= 0");
  CHECK(refused("people = 'a'") == "h.toml:1: people: 'a' is not a list of texts");
  CHECK(refused("people = [1]") == "h.toml:1: people: 1 in the list is not a text in quotes");
  CHECK(refused("colour = \"gren\"") ==
        "h.toml:1: colour: \"gren\" is not known, did you mean \"green\"?, allowed: red, green");
  CHECK(refused("\n[wall]\nbricks = [1]") == "h.toml:2: wall.height: missing, but required");
  CHECK(refused("\n[wall]\nheigth = 2") == "h.toml:3: wall.heigth: unknown key, did you mean height?");
  CHECK(refused("[wall]\nheight = 4") == "h.toml:2: wall.height: 4 is not allowed, must be in [1, 3]");
  CHECK(refused("[wall]\nheight = 2\nbricks = [1, 0]") ==
        "h.toml:3: wall.bricks: 0 in the list is not allowed, must be > 0");
  CHECK(refused("wall = 3") == "h.toml:1: wall: must be a table: [wall]");
}

TEST_CASE("ranges know what they contain and how to say it") {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  CHECK(positive.contains(1e-300));
  CHECK_FALSE(positive.contains(0));
  CHECK_FALSE(positive.contains(inf));
  CHECK_FALSE(positive.contains(nan));
  CHECK_FALSE(any_number.contains(nan));
  CHECK(unit_interval.contains(1));
  CHECK_FALSE(unit_interval.contains(1.0000001));
  CHECK(Range{0, 1, true, true}.describe() == "in (0, 1)");
  CHECK(positive.describe() == "> 0");
  CHECK(at_least(3).describe() == ">= 3");
  CHECK(any_number.describe() == "finite");
}

TEST_CASE("the nearest word is one that looks like a slip") {
  const std::vector<std::string> known{"stiffness", "restitution", "damping"};
  CHECK(nearest("stifness", known) == "stiffness");
  CHECK(nearest("restituton", known) == "restitution");
  CHECK(nearest("colour", known).empty());
  CHECK(nearest("", known).empty());
}

TEST_CASE("a path may go through the n-th of several tables") {
  const std::string walls = "wall = [{height = 1}, {height = 2}]";
  CHECK(set_in(walls, "wall[1].height=3") == "wall = [ { height = 1 }, { height = 3 } ]");
  CHECK(set_in(walls, "wall[0].brick.size=3") ==
        "wall = [ { brick = { size = 3 }, height = 1 }, { height = 2 } ]");
  for (const auto* part :
       {"wall[2]", "wall[-1]", "wall[]", "wall[0", "wall[0]]", "wall[0x]", "roof[0]", "[0]"})
    CHECK(set_in(walls, std::string(part) + ".height=3") ==
          "--set " + std::string(part) + ".height: there is no table " + part);
  CHECK(set_in("wall = [1, 2]", "wall[0].height=3") == "--set wall[0].height: there is no table wall[0]");
}
