#pragma once

#include <array>

#include "core/cloud/cloud_view.hpp"
#include "test/fuzz/input.hpp"

namespace pilothouse {

/// A CloudBytes of arbitrary parts: width, height, point_step, row_step, flags, up to 8 fields,
/// then the data. corpus/make_corpus.py writes the same.
struct CloudInput {
  explicit CloudInput(FuzzInput input) {
    bytes.width = input.take<std::uint32_t>();
    bytes.height = input.take<std::uint32_t>();
    bytes.point_step = input.take<std::uint32_t>();
    bytes.row_step = input.take<std::uint32_t>();
    const auto flags = input.take<std::uint8_t>();  // 1: big endian, 2: unaligned
    bytes.is_bigendian = (flags & 1U) != 0;
    bytes.field_count = input.take<std::uint8_t>() % (fields.size() + 1);
    constexpr std::array<std::string_view, 5> kNames{"x", "y", "z", "rgb", ""};
    for (std::size_t i = 0; i < bytes.field_count; ++i) {
      fields[i].name = kNames[input.take<std::uint8_t>() % kNames.size()];
      fields[i].offset = input.take<std::uint32_t>();
      fields[i].datatype = input.take<std::uint8_t>();
      fields[i].count = input.take<std::uint32_t>();
    }
    bytes.fields = fields.data();
    data = input.rest((flags & 2U) != 0 ? 1 : 0);
    bytes.data = data.data();
    bytes.size = input.left();
  }
  CloudInput(const CloudInput&) = delete;
  CloudInput& operator=(const CloudInput&) = delete;

  std::array<CloudField, 8> fields{};
  FuzzBytes data;
  CloudBytes bytes{};
};

}  // namespace pilothouse
