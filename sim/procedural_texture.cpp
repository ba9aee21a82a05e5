#include "sim/procedural_texture.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "sim/random.hpp"

namespace pilothouse::sim {
namespace {

using Eigen::Vector3f;
constexpr int kSide = 512;

/// 0..1, the same for the same place and seed.
float speckle(int x, int y, std::uint64_t seed) {
  const auto place = static_cast<std::uint64_t>(x + 65536 * y);
  return static_cast<float>(mixSeed(seed, place) >> 40U) * (1.0F / 16777216.0F);
}

/// Speckle of cells `cell_x` by `cell_y` pixels, smooth between them; repeats with the picture.
float cloud(int x, int y, int cell_x, int cell_y, std::uint64_t seed) {
  const int columns = kSide / cell_x, rows = kSide / cell_y;
  const int column = x / cell_x, row = y / cell_y;
  const auto eased = [](int rest, int cell) {
    const float t = static_cast<float>(rest) / static_cast<float>(cell);
    return t * t * (3.0F - 2.0F * t);
  };
  const float right = eased(x % cell_x, cell_x), low = eased(y % cell_y, cell_y);
  const auto at = [&](int dx, int dy) {
    return speckle((column + dx) % columns, (row + dy) % rows, seed);
  };
  const float top = at(0, 0) + right * (at(1, 0) - at(0, 0));
  const float bottom = at(0, 1) + right * (at(1, 1) - at(0, 1));
  return top + low * (bottom - top);
}

Vector3f wood(int x, int y) {
  constexpr int kPlank = 64;  // eight planks beside each other, each cut in two
  const int plank = y / kPlank;
  const int shifted = (x + plank * 197) % kSide;
  const int piece = 2 * plank + shifted / 256;
  const float tone = 0.82F + 0.30F * speckle(piece, 0, 11);
  const float grain = cloud((x + piece * 64) % kSide, y, 64, 4, 12);
  const float fine = cloud((x + piece * 32) % kSide, y, 32, 2, 13);
  const bool gap = y % kPlank < 2 || shifted % 256 < 2;
  return Vector3f(0.70F, 0.50F, 0.32F) *
         (gap ? 0.45F : tone * (0.78F + 0.18F * grain + 0.10F * fine));
}

Vector3f board(int x, int y) {
  const float ring = cloud(x, y, 128, 8, 21) + 0.5F * cloud(x, y, 64, 4, 22);
  return Vector3f(0.78F, 0.60F, 0.40F) * (0.80F + 0.18F * ring);
}

Vector3f tiles(int x, int y) {
  constexpr int kTile = 128;
  if (x % kTile < 4 || y % kTile < 4) return {0.52F, 0.51F, 0.49F};
  const float tone = 0.94F + 0.08F * speckle(x / kTile, y / kTile, 31);
  return Vector3f(0.82F, 0.80F, 0.76F) * (tone - 0.08F * cloud(x, y, 32, 32, 32));
}

Vector3f checkerboard(int x, int y) {
  const bool dark = ((x / 256) + (y / 256)) % 2 == 1;
  return dark ? Vector3f(0.22F, 0.24F, 0.28F) : Vector3f(0.88F, 0.88F, 0.86F);
}

Vector3f carpet(int x, int y) {
  const bool border = std::min({x, y, kSide - 1 - x, kSide - 1 - y}) % 128 < 10;
  const int dx = std::abs(x % 128 - 64), dy = std::abs(y % 128 - 64);
  const bool rhomb = dx + dy < 40 && dx + dy > 22;
  const float pile = 0.82F + 0.30F * speckle(x / 2, y / 2, 41);
  const Vector3f colour = border  ? Vector3f(0.72F, 0.62F, 0.42F)
                          : rhomb ? Vector3f(0.80F, 0.70F, 0.52F)
                                  : Vector3f(0.52F, 0.16F, 0.17F);
  return colour * pile;
}

Vector3f fabric(int x, int y) {
  const float thread = ((x / 3 + y / 3) % 2 == 0 ? 0.92F : 1.0F);
  return Vector3f::Constant(thread * (0.86F + 0.12F * cloud(x, y, 16, 16, 51)));
}

Vector3f brick(int x, int y) {
  constexpr int kHigh = 32, kWide = 128;
  const int row = y / kHigh;
  const int shifted = (x + (row % 2) * kWide / 2) % kSide;
  if (y % kHigh < 4 || shifted % kWide < 4) return {0.72F, 0.69F, 0.65F};
  const float tone = 0.80F + 0.32F * speckle(shifted / kWide, row, 61);
  return Vector3f(0.66F, 0.34F, 0.26F) * (tone - 0.16F * cloud(x, y, 8, 8, 62));
}

Vector3f cardboard(int x, int y) {
  const float wave = 0.97F + 0.03F * std::sin(static_cast<float>(x) * 2.0F * 3.14159265F / 8.0F);
  const bool tape = y > 240 && y < 272;
  const Vector3f colour = tape ? Vector3f(0.80F, 0.70F, 0.50F) : Vector3f(0.72F, 0.56F, 0.38F);
  return colour * (wave * (0.92F + 0.10F * cloud(x, y, 32, 8, 71)));
}

Vector3f concrete(int x, int y) {
  const float blot = cloud(x, y, 128, 128, 81) + 0.6F * cloud(x, y, 32, 32, 82);
  return Vector3f(0.62F, 0.62F, 0.61F) * (0.86F + 0.12F * blot + 0.05F * speckle(x, y, 83));
}

Vector3f plaster(int x, int y) {
  const float blot = cloud(x, y, 64, 64, 91) + 0.4F * cloud(x, y, 8, 8, 92);
  return Vector3f::Constant(0.95F + 0.04F * blot);
}

Vector3f books(int x, int y) {
  constexpr int kShelf = 256;
  const int shelf = y / kShelf, from_top = y % kShelf;
  static const Vector3f covers[] = {{0.62F, 0.20F, 0.18F}, {0.18F, 0.32F, 0.50F},
                                    {0.22F, 0.42F, 0.28F}, {0.78F, 0.66F, 0.36F},
                                    {0.42F, 0.26F, 0.42F}, {0.86F, 0.84F, 0.78F}};
  const int book = x / 32;
  const int height = 232 - static_cast<int>(60.0F * speckle(book, shelf, 101));
  if (kShelf - from_top < 10) return {0.52F, 0.38F, 0.25F};
  if (kShelf - from_top > height || x % 32 < 2) return {0.20F, 0.14F, 0.10F};
  const auto cover = static_cast<std::size_t>(5.99F * speckle(book, shelf, 102));
  const bool band = std::abs(kShelf - from_top - height + 40) < 6;
  return covers[cover] * (band ? 1.25F : 0.95F);
}

Vector3f leaves(int x, int y) {
  const float a = cloud(x, y, 32, 16, 111), b = cloud(x, y, 16, 32, 112);
  return Vector3f(0.20F, 0.46F, 0.18F) * (0.55F + 0.8F * a * b + 0.25F * b);
}

Vector3f asphalt(int x, int y) {
  return Vector3f(0.36F, 0.36F, 0.38F) * (0.80F + 0.35F * speckle(x / 2, y / 2, 121));
}

struct Recipe {
  const char* name;
  Vector3f (*colour)(int x, int y);
  double metres;
};
constexpr Recipe kRecipes[] = {{"asphalt", asphalt, 1.0},
                               {"board", board, 1.2},
                               {"books", books, 0.8},
                               {"brick", brick, 1.0},
                               {"cardboard", cardboard, 0.5},
                               {"carpet", carpet, 1.0},
                               {"checkerboard", checkerboard, 1.0},
                               {"concrete", concrete, 3.0},
                               {"fabric", fabric, 0.4},
                               {"leaves", leaves, 0.5},
                               {"plaster", plaster, 2.0},
                               {"tiles", tiles, 1.2},
                               {"wood", wood, 1.2}};

ProceduralTexture make(const Recipe& recipe) {
  ProceduralTexture texture{{kSide, kSide, {}}, recipe.metres};
  texture.picture.rgb.reserve(std::size_t{3} * kSide * kSide);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Vector3f colour = recipe.colour(x, y);
      for (int c = 0; c < 3; ++c) {
        texture.picture.rgb.push_back(
            static_cast<std::uint8_t>(255.0F * std::clamp(colour[c], 0.0F, 1.0F)));
      }
    }
  }
  return texture;
}

}  // namespace

const ProceduralTexture* proceduralTexture(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, ProceduralTexture> made;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto known = made.find(name);
  if (known != made.end()) return &known->second;
  for (const Recipe& recipe : kRecipes)
    if (name == recipe.name) return &made.emplace(name, make(recipe)).first->second;
  return nullptr;
}

std::vector<std::string> proceduralTextureNames() {
  std::vector<std::string> names;
  for (const Recipe& recipe : kRecipes) names.push_back(recipe.name);
  return names;
}

}  // namespace pilothouse::sim
