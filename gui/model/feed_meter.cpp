#include "gui/model/feed_meter.hpp"

#include <algorithm>

namespace pilothouse::gui {

namespace {
constexpr double kWindow = 4.0;               // s of arrivals that make the rate
constexpr std::size_t kMostKept = 512;        // bounds the memory of a flooded topic
constexpr double kRejectionShown = 5.0;       // s
constexpr std::uint32_t kLargestGap = 10000;  // a larger one is a restart, not a loss
}  // namespace

Freshness freshness(const FeedState& state) {
  if (!state.ever) return Freshness::kNever;
  if (state.age_s > kStaleAfter) return Freshness::kStale;
  const double late = state.rate_hz > 0.0 ? std::max(0.5, 2.5 / state.rate_hz) : 1.5;
  return state.age_s > late ? Freshness::kLate : Freshness::kFresh;
}

void FeedMeter::arrived(double now, std::uint32_t seq, const std::string& publisher,
                        const std::string& topic) {
  const bool follows = publisher == publisher_ && topic == topic_ && !arrivals_.empty();
  if (follows && seq > seq_ + 1 && seq - seq_ < kLargestGap) drops_ += seq - seq_ - 1;
  publisher_ = publisher;
  topic_ = topic;
  seq_ = seq;
  arrivals_.push_back(now);
  while (arrivals_.size() > kMostKept ||
         (arrivals_.size() > 2 && arrivals_.front() < now - kWindow)) {
    arrivals_.pop_front();
  }
}

void FeedMeter::accepted(double arrival, double latency) {
  origin_ = arrival - std::max(0.0, latency);
  ever_ = true;
  rejection_.clear();
}

void FeedMeter::rejected(double now, const std::string& reason) {
  ++rejected_;
  rejected_at_ = now;
  rejection_ = reason;
}

FeedState FeedMeter::state(double now) const {
  FeedState state;
  state.ever = ever_;
  state.age_s = ever_ ? std::max(0.0, now - origin_) : 0.0;
  state.drops = drops_;
  state.rejected = rejected_;
  if (now - rejected_at_ < kRejectionShown) state.rejection = rejection_;
  state.topic = topic_;
  const auto first = std::find_if(arrivals_.begin(), arrivals_.end(),
                                  [&](double t) { return t >= now - kWindow; });
  const auto n = std::distance(first, arrivals_.end());
  if (n >= 2 && arrivals_.back() > *first) {
    state.rate_hz = static_cast<double>(n - 1) / (arrivals_.back() - *first);
  }
  return state;
}

}  // namespace pilothouse::gui
