// Maps in files: what was saved comes back, what is bad is refused by name, and a kill in the
// middle leaves the old map whole.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <string>

#include "core/mapping/map_bytes.hpp"
#include "doors/file_bytes.hpp"
#include "doors/map_files.hpp"

namespace pilothouse {
namespace {

namespace fs = std::filesystem;

class MapFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "pilothouse_maps_XXXXXX").string();
    ASSERT_NE(mkdtemp(&pattern[0]), nullptr);
    folder = pattern;
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string path(const std::string& name) const { return folder + "/" + name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }
  /// Why a YAML and its picture are refused.
  std::string refusal(const std::string& yaml, const std::string& pgm) const {
    write("bad.yaml", yaml);
    write("bad.pgm", pgm);
    const auto map = loadMap(folder, "bad", {});
    return map ? "accepted" : map.reason();
  }

  std::string folder;
};

OccupancyMap randomMap(unsigned seed, double cell_size = 0.05) {
  OccupancyParameters parameters;
  parameters.cell_size = cell_size;
  OccupancyMap map(parameters);
  std::mt19937 random(seed);
  const auto whole = [&random](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  for (int i = 0; i < 5; ++i) {
    OccupancyMap::Block& block = *map.ensureBlock(whole(-8, 7), whole(-8, 7));
    for (auto& cell : block) {
      cell.odds = static_cast<std::int16_t>(whole(-190, 190));
      cell.threshold = static_cast<std::int8_t>(whole(-3, 3));
      cell.drop_off = static_cast<std::int8_t>(whole(-3, 3));
    }
  }
  return map;
}

constexpr char kYaml[] = "image: bad.pgm\nresolution: 0.05\norigin: [-1.0, -0.5, 0]\n";
const std::string kPgm = std::string("P5\n# made by hand\n3 2\n255\n") + "\x01\xCD\xFE\xFE\xFE\xFE";

TEST_F(MapFilesTest, EveryValueComesBackFromOurOwnForm) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const OccupancyMap map = randomMap(seed, 0.02 + 0.005 * seed);
    saveMap(folder, "room", filesOf(map));
    const auto loaded = loadMap(folder, "room", {});
    ASSERT_TRUE(loaded) << loaded.reason();
    EXPECT_EQ(encodeMap(**loaded), encodeMap(map));
    EXPECT_EQ((*loaded)->parameters().cell_size, map.parameters().cell_size);
  }
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder)) files += entry.exists() ? 1 : 0;
  EXPECT_EQ(files, 3U) << "phmap, yaml and one picture; no temporary or older ones";
}

TEST_F(MapFilesTest, MapServersFormKeepsWhatIsFreeOccupiedAndUnknown) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    OccupancyMap map = randomMap(seed);
    saveMap(folder, "room", filesOf(map));
    const auto loaded = loadMapServer(path("room.yaml"), {});
    ASSERT_TRUE(loaded) << loaded.reason();
    MapCells cells;
    map.snapshot(cells);
    for (int iy = 0; iy < cells.size_y; ++iy) {
      for (int ix = 0; ix < cells.size_x; ++ix) {
        const double x = cells.centreX(ix), y = cells.centreY(iy);
        MapCell expected = cells.at(ix, iy);
        if (expected == MapCell::kThreshold) expected = MapCell::kFree;
        if (expected == MapCell::kDropOff) expected = MapCell::kOccupied;
        ASSERT_EQ((*loaded)->at((*loaded)->cellOf(x, y)), expected) << x << " " << y;
      }
    }
  }
}

TEST_F(MapFilesTest, ReadsWhatOthersWrite) {
  write("other.yaml",
        "image: bad.pgm\nresolution: 0.1\norigin: [-1.03, -0.5, 0.0]\nnegate: 1\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: trinary\nnote: theirs\n");
  write("bad.pgm", "P5 2 1 100\n\x5A\x05");  // 90 and 5 of 100, white is occupied
  const auto map = loadMap(folder, "other", {});
  ASSERT_TRUE(map) << map.reason();
  EXPECT_EQ((*map)->parameters().cell_size, 0.1);
  EXPECT_EQ((*map)->at((*map)->cellOf(-1.02, -0.45)), MapCell::kOccupied);
  EXPECT_EQ((*map)->at((*map)->cellOf(-0.94, -0.45)), MapCell::kOccupied) << "the pixel's far end";
  EXPECT_EQ((*map)->at((*map)->cellOf(-0.92, -0.45)), MapCell::kFree);
  EXPECT_EQ((*map)->at((*map)->cellOf(-1.04, -0.45)), MapCell::kUnknown);
}

TEST_F(MapFilesTest, ReadsWhatMapSaverWritesForAFolder) {
  // rosrun map_server map_saver -f /home/robot/maps/hall, and moved since.
  write("hall.yaml",
        "image: /home/robot/maps/hall.pgm\nresolution: 0.050000\norigin: [-1.000000, -1.000000, "
        "-0.000000]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n");
  EXPECT_NE(loadMap(folder, "hall", {}).reason().find("in the same folder"), std::string::npos);
  write("hall.pgm",
        std::string("P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 1\n255\n") + '\0' + "\xFE\xCD");
  const auto map = loadMap(folder, "hall", {});
  ASSERT_TRUE(map) << map.reason();
  EXPECT_EQ((*map)->at((*map)->cellOf(-0.98, -0.98)), MapCell::kOccupied);
  EXPECT_EQ((*map)->at((*map)->cellOf(-0.93, -0.98)), MapCell::kFree);
  EXPECT_EQ((*map)->at((*map)->cellOf(-0.88, -0.98)), MapCell::kUnknown);
}

TEST_F(MapFilesTest, RefusesBadPicturesByName) {
  EXPECT_EQ(refusal(kYaml, kPgm), "accepted");
  const std::string at = path("bad.pgm") + ": ";
  EXPECT_EQ(refusal(kYaml, kPgm.substr(0, kPgm.size() - 1)),
            at + "the picture holds 5 pixels, expected 3 x 2 = 6");
  EXPECT_EQ(refusal(kYaml, kPgm + "x"), at + "the picture holds 7 pixels, expected 3 x 2 = 6");
  EXPECT_EQ(refusal(kYaml, "P2 1 1 255 0"),
            at + "the beginning is \"P2\", expected that of a PGM, P5");
  EXPECT_EQ(refusal(kYaml, "P5 99999 99999 255 "),
            at + "the picture is 99999 x 99999 pixels, expected 1 to 20000 a side");
  EXPECT_EQ(refusal(kYaml, "P5 1 1 65535 ab"),
            at + "the greatest value is 65535, expected 1 to 255");
  EXPECT_NE(refusal(kYaml, "P5 3").find("header ends"), std::string::npos);
  EXPECT_NE(refusal(kYaml, "").find(at + "the beginning is"), std::string::npos);
}

TEST_F(MapFilesTest, RefusesBadYamlByName) {
  const auto yaml = [](const std::string& resolution, const std::string& origin,
                       const std::string& rest = "") {
    return "image: bad.pgm\nresolution: " + resolution + "\norigin: " + origin + "\n" + rest;
  };
  const std::string at = path("bad.yaml") + ": ";
  EXPECT_EQ(refusal(yaml(".nan", "[0, 0, 0]"), kPgm),
            at + "resolution is nan (a double), expected a number from 0.01 to 0.5");
  EXPECT_EQ(refusal(yaml("1e-9", "[0, 0, 0]"), kPgm),
            at + "resolution is 1e-09 (a double), expected a number from 0.01 to 0.5");
  EXPECT_EQ(refusal(yaml("0.05", "[0, 0, 1.57]"), kPgm),
            at + "origin is of 3 entries (a list), expected [x, y, 0]: two numbers [m] and no "
                 "rotation");
  EXPECT_NE(refusal(yaml("0.05", "[.inf, 0, 0]"), kPgm).find("origin is inf"), std::string::npos);
  EXPECT_NE(refusal(yaml("0.05", "[200, 0, 0]"), kPgm).find("outside of the map's square"),
            std::string::npos);
  EXPECT_NE(refusal(yaml("0.05", "[0, 0, 0]", "free_thresh: 0.9\n"), kPgm).find("free_thresh"),
            std::string::npos);
  EXPECT_NE(refusal("resolution: 0.05\norigin: [0, 0, 0]\n", kPgm).find("image is missing"),
            std::string::npos);
  EXPECT_NE(refusal("image: ../../etc/passwd\nresolution: 0.05\norigin: [0, 0, 0]\n", kPgm)
                .find("in the same folder"),
            std::string::npos);
  EXPECT_NE(refusal("[", kPgm).find("not YAML"), std::string::npos);
  EXPECT_NE(refusal("", kPgm), "accepted");
  EXPECT_NE(loadMap(folder, "none", {}).reason().find("no such map"), std::string::npos);
}

TEST_F(MapFilesTest, RefusesEveryFileOfItsOwnThatIsNotWhole) {
  const OccupancyMap map = randomMap(7);
  const std::string good = encodeMap(map);
  ASSERT_TRUE(decodeMap(good, {}));
  EXPECT_EQ(decodeMap(good.substr(0, good.size() - 1), {}).reason(),
            "size is " + std::to_string(good.size() - 1) + " bytes, expected " +
                std::to_string(good.size()));
  EXPECT_EQ(decodeMap("PHMAP", {}).reason(), "size is 5 bytes, expected at least 64");
  EXPECT_NE(decodeMap(std::string(2000, '\xFF'), {}).reason().find("the beginning is"),
            std::string::npos);
  for (std::size_t i = 0; i < good.size(); i += 13) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    EXPECT_FALSE(decodeMap(bad, {})) << "a bit of byte " << i;
  }
  OccupancyParameters small;
  small.max_side = 1.0;
  EXPECT_NE(decodeMap(good, small).reason().find("outside of the map's square"), std::string::npos);
  write("room.phmap", good.substr(0, 100));
  EXPECT_EQ(loadMap(folder, "room", {}).reason().find(path("room.phmap") + ": size is 100"), 0U);
}

TEST_F(MapFilesTest, NamesDoNotLeaveTheFolder) {
  for (const std::string name : {"../room", "a/b", "", ".", "room.yaml", "a b"}) {
    EXPECT_NE(mapNameFault(name), "") << name;
    EXPECT_THROW(saveMap(folder, name, filesOf(randomMap(1))), std::runtime_error);
    EXPECT_FALSE(loadMap(folder, name, {}));
  }
  EXPECT_NE(mapNameFault(std::string(65, 'a')), "");
  EXPECT_EQ(mapNameFault("Room-2_b"), "");
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(MapFilesTest, AFailedSaveLeavesTheOldOneAndNoLitter) {
  saveMap(folder, "room", filesOf(randomMap(1)));
  fs::create_directory(path("wall.phmap"));  // cannot be replaced by a file
  EXPECT_THROW(saveMap(folder, "wall", filesOf(randomMap(2))), std::runtime_error);
  for (const auto& entry : fs::directory_iterator(folder)) {
    EXPECT_NE(entry.path().extension(), ".tmp");
  }
  EXPECT_EQ(encodeMap(**loadMap(folder, "room", {})), encodeMap(randomMap(1)));
}

// A process that saves one map after the other is killed at any moment.
TEST_F(MapFilesTest, KilledWhileSavingLeavesAWholeMap) {
  const OccupancyMap maps[] = {randomMap(1), randomMap(2)};
  const MapFiles files[] = {filesOf(maps[0]), filesOf(maps[1])};
  saveMap(folder, "room", files[0]);
  std::mt19937 random(5);
  for (int kill_number = 0; kill_number < 30; ++kill_number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (int i = 0;; ++i) saveMap(folder, "room", files[i % 2]);
    }
    usleep(std::uniform_int_distribution<unsigned>(0, 20000)(random));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto own = loadMap(folder, "room", {});
    ASSERT_TRUE(own) << own.reason();
    const std::string bytes = encodeMap(**own);
    EXPECT_TRUE(bytes == files[0].own || bytes == files[1].own);
    const auto others = loadMapServer(path("room.yaml"), {});
    ASSERT_TRUE(others) << others.reason();
  }
}

}  // namespace
}  // namespace pilothouse
