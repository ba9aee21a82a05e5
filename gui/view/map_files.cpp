#include "gui/view/map_files.hpp"

#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "gui/view/sheet.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

MapFiles::MapFiles(AskPlace ask, QWidget* over)
    : QObject(over), ask_(std::move(ask)), over_(over) {}

void MapFiles::save() {
  askName(tr("Save the map"),
          tr("Name of the map in the robot's folder; one of this name is replaced:"), tr("Save"),
          [](PlaceAsks& asks, const std::string& name) { asks.saveMap(name); });
}

void MapFiles::load() {
  askName(tr("Load a map"),
          tr("Name of the map in the robot's folder; it takes the place of what was learnt:"),
          tr("Load"), [](PlaceAsks& asks, const std::string& name) { asks.loadMap(name); });
}

void MapFiles::clear() {
  if (!ask_) return;
  auto* box = new QMessageBox(QMessageBox::Question, tr("Clear the map"),
                              tr("Forget the map that was learnt?"), QMessageBox::NoButton, over_);
  box->setObjectName("map_clear");
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setInformativeText(
      tr("Maps that were saved stay. A goal that is under way is planned anew."));
  box->addButton(tr("Clear"), QMessageBox::AcceptRole)->setIcon(QIcon());
  auto* keep = box->addButton(tr("Keep"), QMessageBox::RejectRole);
  keep->setIcon(QIcon());
  box->setDefaultButton(keep);
  box->setEscapeButton(keep);
  connect(box, &QMessageBox::buttonClicked, this, [this, keep](QAbstractButton* chosen) {
    if (chosen != keep) ask_([](PlaceAsks& asks) { asks.clearMap(); });
  });
  showBeside(*box, *over_);
}

void MapFiles::askName(const QString& title, const QString& text, const QString& act,
                       const std::function<void(PlaceAsks&, const std::string&)>& what) {
  if (!ask_) return;
  auto* dialog = new QDialog(over_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setObjectName("map_name_dialog");
  dialog->setWindowTitle(title);
  auto* name = new QLineEdit(last_);
  name->setObjectName("map_name");
  name->setMaxLength(64);
  name->selectAll();
  auto* fault = new QLabel;
  fault->setFont(theme::smallFont());
  auto* buttons = new QDialogButtonBox;
  auto* go = buttons->addButton(act, QDialogButtonBox::AcceptRole);
  buttons->addButton(tr("Cancel"), QDialogButtonBox::RejectRole);
  for (auto* button : buttons->buttons()) button->setIcon(QIcon());
  auto* layout = new QVBoxLayout(dialog);
  layout->setContentsMargins(20, 16, 20, 14);
  layout->setSpacing(theme::kSpace);
  for (QWidget* row : {static_cast<QWidget*>(new QLabel(text)), static_cast<QWidget*>(name),
                       static_cast<QWidget*>(fault), static_cast<QWidget*>(buttons)}) {
    layout->addWidget(row);
  }
  const auto judge = [name, fault, go] {
    const std::string why = routeNameFault(name->text().toStdString());
    fault->setText(QString::fromStdString(why));
    go->setEnabled(why.empty());
  };
  connect(name, &QLineEdit::textChanged, dialog, judge);
  judge();
  connect(buttons, &QDialogButtonBox::accepted, dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::reject);
  connect(dialog, &QDialog::accepted, this, [this, name, what] {
    last_ = name->text();
    ask_([&](PlaceAsks& asks) { what(asks, last_.toStdString()); });
  });
  showBeside(*dialog, *over_);
}

}  // namespace pilothouse::gui
