#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pilothouse {

/// How a route rounds its corners.
struct CornerParameters {
  double radius =
      0.5;  ///< wished [m], 0..10; less where the legs are too short or the cut too deep
  double max_cut = 0.1;  ///< the way passes a corner's point at most this far off [m], 0..5
};

/// A way over points in a fixed frame: straight legs and arcs that touch them. A corner whose arc
/// would be tighter than kTightest stays sharp: a place to stop and turn at. Ways are measured
/// along it from its first point [m]; those of a loop go on rising, round after round.
class Route {
 public:
  static constexpr double kTightest = 0.05;  ///< [m]

  Route() = default;
  /// @param points finite [m]; those within 1 mm of the one before are left out.
  /// @param loop_from the way goes back to this point after the last, again and again; no loop when
  ///   it is none of the points, or fewer than two are left from it on.
  Route(const std::vector<Eigen::Vector2d>& points, const CornerParameters& corners,
        std::size_t loop_from = kNoLoop);
  static constexpr std::size_t kNoLoop = static_cast<std::size_t>(-1);

  bool empty() const { return pieces_.empty(); }
  bool loop() const { return loop_; }
  /// Where the way ends; of a loop, where its first round does.
  double length() const { return length_; }
  /// Of one round; 0 unless a loop.
  double round() const { return loop_ ? length_ - loop_begin_ : 0.0; }

  struct Place {
    Eigen::Vector2d position;
    Eigen::Vector2d direction;  ///< unit
    double curvature;           ///< positive turns left [1/m]
  };
  Place at(double way) const;

  struct Foot {
    double way = 0.0;
    double distance = 0.0;  ///< of the point from it [m]
  };
  /// The place of [from, to] that is nearest to the point; the earlier of equals.
  Foot nearest(const Eigen::Vector2d& point, double from, double to) const;

  /// Where the robot must stop next at or beyond `way`: a sharp corner or the end; infinite on a
  /// loop without sharp corners.
  double stopAfter(double way) const;
  /// Index, among the points given, of the one that is driven to at `way`.
  std::size_t target(double way) const;
  /// Curvatures met within [from, to], for speeds: calls visit(way at which it begins,
  /// |curvature|).
  template <class Visit>
  void curvatures(double from, double to, Visit visit) const;

 private:
  struct Piece {
    double start = 0.0, length = 0.0;  ///< [m]
    Eigen::Vector2d begin{0.0, 0.0};
    Eigen::Vector2d direction{1.0, 0.0};  ///< at the begin
    double curvature = 0.0;
    std::size_t target = 0;
    bool sharp_end = false;
  };
  struct At {
    std::size_t piece;
    double offset;  ///< way - offset lies in the first round
  };
  static Place along(const Piece& piece, double way);
  static Foot nearestOn(const Piece& piece, const Eigen::Vector2d& point, double from, double to);
  void append(const Eigen::Vector2d& to, double curvature, double length,
              const Eigen::Vector2d& direction, std::size_t target);
  At find(double way) const;
  /// The piece after; round and round a loop. @return false behind the end.
  bool next(At& at) const;

  std::vector<Piece> pieces_;
  Eigen::Vector2d pen_{0.0, 0.0};
  double length_ = 0.0;
  bool loop_ = false;
  double loop_begin_ = 0.0;
  std::size_t loop_piece_ = 0;
};

template <class Visit>
void Route::curvatures(double from, double to, Visit visit) const {
  if (empty()) return;
  At at = find(from);
  do {
    const Piece& piece = pieces_[at.piece];
    const double begin = piece.start + at.offset;
    if (begin > to) return;
    visit(begin, piece.curvature < 0.0 ? -piece.curvature : piece.curvature);
  } while (next(at));
}

}  // namespace pilothouse
