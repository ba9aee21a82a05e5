#include "bench/track_error.hpp"

#include <algorithm>
#include <cmath>

#include "bench/pose_replay.hpp"
#include "core/pose/pose_algebra.hpp"

namespace pilothouse::bench {

Pose2 rigidAlignment(const std::vector<StampedPose>& track,
                     const std::vector<StampedPose>& reference) {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(), to = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < track.size(); ++i) {
    from += track[i].second.position();
    to += reference[i].second.position();
  }
  from /= static_cast<double>(track.size());
  to /= static_cast<double>(track.size());
  double sine = 0.0, cosine = 0.0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Eigen::Vector2d a = track[i].second.position() - from;
    const Eigen::Vector2d b = reference[i].second.position() - to;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 turn{0.0, 0.0, std::atan2(sine, cosine)};
  const Eigen::Vector2d shift = to - turn * from;
  return {shift.x(), shift.y(), turn.heading};
}

Pose2 startAlignment(const std::vector<StampedPose>& track,
                     const std::vector<StampedPose>& reference, std::size_t count) {
  count = std::min(count, track.size());
  Eigen::Vector2d shift = Eigen::Vector2d::Zero(), direction = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = reference[i].second.heading - track[i].second.heading;
    direction += Eigen::Vector2d(std::cos(turn), std::sin(turn));
  }
  const Pose2 turn{0.0, 0.0, std::atan2(direction.y(), direction.x())};
  for (std::size_t i = 0; i < count; ++i) {
    shift += reference[i].second.position() - turn * track[i].second.position();
  }
  shift /= static_cast<double>(count);
  return {shift.x(), shift.y(), turn.heading};
}

TrackError errorOf(const std::vector<StampedPose>& track, const std::vector<StampedPose>& reference,
                   const Pose2& T_reference_track) {
  TrackError error;
  double squares = 0.0, turns = 0.0;
  for (std::size_t i = 0; i < track.size(); ++i) {
    const Pose2 placed = composed(T_reference_track, track[i].second);
    const double distance = (placed.position() - reference[i].second.position()).norm();
    const double turn = wrapped(placed.heading - reference[i].second.heading);
    squares += distance * distance;
    turns += turn * turn;
    error.max = std::max(error.max, distance);
  }
  const double count = static_cast<double>(std::max<std::size_t>(1, track.size()));
  error.rms = std::sqrt(squares / count);
  error.heading_rms = std::sqrt(turns / count);
  return error;
}

std::vector<StampedPose> later(std::vector<StampedPose> reference, double offset) {
  for (StampedPose& pose : reference) pose.first += offset;
  return reference;
}

double timeOffset(const std::vector<StampedPose>& track,
                  const std::vector<StampedPose>& reference) {
  constexpr double kMost = 0.2, kStep = 0.005;  // [s]
  // Poses that any of the offsets would push off the track would make the sums differ.
  std::vector<StampedPose> inner;
  for (const StampedPose& pose : reference) {
    if (pose.first - kMost < track.front().first || pose.first + kMost > track.back().first) {
      continue;
    }
    inner.push_back(pose);
  }
  if (inner.size() < 10) return 0.0;
  double best = 0.0, least = INFINITY;
  const int steps = static_cast<int>(std::lround(kMost / kStep));
  for (int step = -steps; step <= steps; ++step) {
    std::vector<StampedPose> from, to;
    pairUp(track, later(inner, step * kStep), from, to);
    const double rms = errorOf(from, to, rigidAlignment(from, to)).rms;
    if (rms < least) least = rms, best = step * kStep;
  }
  return best;
}

double noiseOf(const std::vector<StampedPose>& smooth, const std::vector<StampedPose>& reference,
               std::size_t piece) {
  if (reference.size() < piece || piece < 3) return std::nan("");
  double squares = 0.0;
  std::size_t pieces = 0;
  for (std::size_t first = 0; first + piece <= reference.size(); ++first, ++pieces) {
    const auto cut = [&](const std::vector<StampedPose>& whole) {
      const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(first);
      return std::vector<StampedPose>(begin, begin + static_cast<std::ptrdiff_t>(piece));
    };
    const auto from = cut(smooth), to = cut(reference);
    const double rms = errorOf(from, to, rigidAlignment(from, to)).rms;
    // Two numbers a pose were measured, three of them were spent on the alignment.
    const double numbers = 2.0 * static_cast<double>(piece);
    squares += rms * rms * numbers / (numbers - 3.0);
  }
  return std::sqrt(squares / static_cast<double>(pieces));
}

}  // namespace pilothouse::bench
