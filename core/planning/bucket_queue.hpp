#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pilothouse {

/// Cells in the order of whole numbers, to the width of a bucket: a ring of buckets (Dial 1969) for
/// what comes next, and a list of what comes after. Nothing may come before what is being taken.
class BucketQueue {
 public:
  static constexpr int kBits = 11;  ///< a bucket is 2^kBits wide
  static constexpr std::uint32_t kBuckets = 64;

  struct Entry {
    std::uint16_t x, y;
    std::uint32_t cost;
  };

  bool empty() const { return waiting_ == 0 && later_.empty(); }
  void push(const Entry& entry, std::uint32_t key) {
    const std::uint32_t bucket = key >> kBits;
    if (bucket - bucket_ < kBuckets) {
      ring_[bucket % kBuckets].push_back(entry);
      ++waiting_;
      return;
    }
    later_.push_back({entry, bucket});
    if (bucket < later_least_) later_least_ = bucket;
  }
  /// To the first bucket that holds anything. @return false: nothing does.
  bool next() {
    if (empty()) return false;
    if (waiting_ == 0) bucket_ = later_least_;
    while (ring_[bucket_ % kBuckets].empty() && bucket_ < later_least_) ++bucket_;
    if (bucket_ >= later_least_) bringIn();
    return true;
  }
  /// Number of the bucket that is being taken.
  std::uint32_t bucket() const { return bucket_; }
  /// Out of that bucket, the last first. @return false: it is empty.
  bool take(Entry& entry) {
    auto& entries = ring_[bucket_ % kBuckets];
    if (entries.empty()) return false;
    entry = entries.back();
    entries.pop_back();
    --waiting_;
    return true;
  }
  /// Hands out everything in any order, and is as new.
  void drain(std::vector<Entry>& all) {
    all.clear();
    for (auto& entries : ring_) {
      all.insert(all.end(), entries.begin(), entries.end());
      entries.clear();
    }
    for (const Later& later : later_) all.push_back(later.entry);
    later_.clear();
    waiting_ = 0;
    bucket_ = kNowhere;
    later_least_ = kNone;
  }

 private:
  static constexpr std::uint32_t kNowhere = 1U << 31;  // no bucket is within a ring of it
  static constexpr std::uint32_t kNone = 0xffffffffU;
  struct Later {
    Entry entry;
    std::uint32_t bucket;
  };
  void bringIn() {
    std::size_t kept = 0;
    later_least_ = kNone;
    for (const Later later : later_) {
      if (later.bucket - bucket_ < kBuckets) {
        ring_[later.bucket % kBuckets].push_back(later.entry);
        ++waiting_;
        continue;
      }
      later_[kept++] = later;
      if (later.bucket < later_least_) later_least_ = later.bucket;
    }
    later_.resize(kept);
  }

  std::array<std::vector<Entry>, kBuckets> ring_;
  std::vector<Later> later_;
  std::size_t waiting_ = 0;  ///< in the ring
  std::uint32_t bucket_ = kNowhere, later_least_ = kNone;
};

}  // namespace pilothouse
