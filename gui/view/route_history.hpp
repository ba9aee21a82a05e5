#pragma once

#include <QUndoStack>

#include "gui/model/route_draft.hpp"

namespace pilothouse::gui {

/// A route with all steps that led to it, each to be taken back and made again.
class RouteHistory : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMostSteps = 500;

  explicit RouteHistory(QObject* parent = nullptr);

  const RouteDraft& draft() const { return draft_; }
  /// A step to another route; none where it is the same. @param grows with the step before where
  /// that was about the same thing (>= 0): a key held down is one step.
  void step(const RouteDraft& after, const QString& what, int grows = -1);
  /// The name is no step: it says where to, not what. A step to a route of another name, as a load
  /// is, takes the name along both ways.
  void setName(const std::string& name) { draft_.name = name; }
  QUndoStack& stack() { return stack_; }

 signals:
  /// @param before the route until now.
  void changed(const RouteDraft& before);

 private:
  friend class RouteStep;
  void put(const RouteDraft& draft, bool renames);

  RouteDraft draft_;
  QUndoStack stack_;
};

}  // namespace pilothouse::gui
