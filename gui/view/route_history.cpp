#include "gui/view/route_history.hpp"

#include <utility>

namespace pilothouse::gui {

class RouteStep : public QUndoCommand {
 public:
  RouteStep(RouteHistory& history, RouteDraft after, const QString& what, int grows)
      : QUndoCommand(what),
        history_(history),
        before_(history.draft()),
        after_(std::move(after)),
        grows_(grows) {}
  void undo() override { history_.put(before_); }
  void redo() override { history_.put(after_); }
  int id() const override { return grows_; }
  bool mergeWith(const QUndoCommand* later) override {
    if (later->id() != grows_) return false;
    after_ = static_cast<const RouteStep*>(later)->after_;
    return true;
  }

 private:
  RouteHistory& history_;
  RouteDraft before_, after_;
  int grows_;
};

RouteHistory::RouteHistory(QObject* parent) : QObject(parent), stack_(this) {
  stack_.setUndoLimit(kMostSteps);
}

void RouteHistory::step(const RouteDraft& after, const QString& what, int grows) {
  if (after == draft_) return;
  stack_.push(new RouteStep(*this, after, what, grows));
}

void RouteHistory::put(const RouteDraft& draft) {
  const std::string name = draft_.name;
  draft_ = draft;
  draft_.name = name;
  emit changed();
}

}  // namespace pilothouse::gui
