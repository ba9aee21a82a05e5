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
        renames_(after_.name != before_.name),
        grows_(grows) {}
  void undo() override { history_.put(before_, renames_); }
  void redo() override { history_.put(after_, renames_); }
  int id() const override { return grows_; }
  bool mergeWith(const QUndoCommand* later) override {
    if (later->id() != grows_) return false;
    after_ = static_cast<const RouteStep*>(later)->after_;
    return true;
  }

 private:
  RouteHistory& history_;
  RouteDraft before_, after_;
  bool renames_;
  int grows_;
};

RouteHistory::RouteHistory(QObject* parent) : QObject(parent), stack_(this) {
  stack_.setUndoLimit(kMostSteps);
}

void RouteHistory::step(const RouteDraft& after, const QString& what, int grows) {
  if (after == draft_) return;
  stack_.push(new RouteStep(*this, after, what, grows));
}

void RouteHistory::put(const RouteDraft& draft, bool renames) {
  const RouteDraft before = std::exchange(draft_, draft);
  if (!renames) draft_.name = before.name;
  emit changed(before);
}

}  // namespace pilothouse::gui
