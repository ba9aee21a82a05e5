// Stop and arming in the window: by key and mouse, beside all that lies over it.

#include <QAction>
#include <QDialog>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QSignalSpy>
#include <QThread>

#include "gui/view/stop_button.hpp"
#include "test/place_console.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

TEST(HoldButton, armsOnlyByTimeThatItWasSeenHeld) {
  HoldButton button;
  button.show("Hold to arm", "F9", true);
  QSignalSpy armed(&button, &HoldButton::confirmed);
  const auto tap = [&](int stall) {
    button.keyDown(false);
    QThread::msleep(static_cast<unsigned long>(stall));  // the window hangs, on purpose
    QTest::qWait(20);  // its clock's tick comes before the release
    button.keyUp();
    QTest::qWait(3 * HoldButton::kDebounce);
  };
  tap(HoldButton::kHold + 200);
  EXPECT_EQ(armed.count(), 0);
  button.keyDown(false);
  ASSERT_TRUE(armed.wait(20000));
  for (int i = 0; i < 40; ++i) {  // kept down: the keyboard says so again and again
    button.keyUp();
    button.keyDown(i % 2 == 0);
    QTest::qWait(30);
  }
  EXPECT_EQ(armed.count(), 1) << "it must be let go before";
  button.keyUp();
  QTest::qWait(3 * HoldButton::kDebounce);
  button.keyDown(false);
  QTest::qWait(50);
  button.drop(true);  // the focus went, and the release with it
  QTest::qWait(HoldButton::kHold + 200);
  EXPECT_EQ(armed.count(), 1);
  button.keyDown(true);  // back, the finger still there
  QTest::qWait(HoldButton::kHold + 200);
  EXPECT_EQ(armed.count(), 1);
  button.keyUp();
  QTest::qWait(3 * HoldButton::kDebounce);
  button.keyDown(false);
  EXPECT_TRUE(armed.wait(20000));
}

TEST_F(PlaceConsole, aStopPressedWhileArmingIsHeldEndsThat) {
  helm.stop();
  refresh();
  auto* arm = window->findChild<HoldButton*>("arm_button");
  ASSERT_TRUE(arm->isEnabled());
  QTest::keyPress(window.get(), Qt::Key_F9);
  QTest::qWait(100);
  helm.stop();
  QTest::qWait(HoldButton::kHold + 300);
  EXPECT_TRUE(armed.empty());
  QTest::keyRelease(window.get(), Qt::Key_F9);
  QTest::qWait(3 * HoldButton::kDebounce);
  QTest::keyPress(window.get(), Qt::Key_F9);
  ASSERT_TRUE(QTest::qWaitFor([&] { return !armed.empty(); }, 20000));
  EXPECT_EQ(armed.back(), helm.stops());
  QTest::keyRelease(window.get(), Qt::Key_F9);
}

TEST_F(PlaceConsole, stoppedIsShownOnlyWhenTheGateSaysSo) {
  auto* stop = window->findChild<StopButton*>("stop_button");
  helm.stop();
  refresh();
  EXPECT_EQ(stop->state(), StopButton::State::kUnconfirmed);
  auto gate = std::make_shared<StopReading>();
  gate->phase = GatePhase::kStopped;
  gate->cause = StopCause::kOperator;
  deliver<StopReading>(state.gate, gate);
  window->refreshNow();
  EXPECT_EQ(stop->state(), StopButton::State::kStopped);
}

TEST_F(PlaceConsole, aLostFocusEndsTheHold) {
  helm.stop();
  refresh();
  QTest::keyPress(window.get(), Qt::Key_F9);
  QTest::qWait(100);
  QWidget other;
  other.show();
  other.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&other));
  QTest::qWait(HoldButton::kHold + 300);
  EXPECT_TRUE(armed.empty());
}

TEST_F(PlaceConsole, theKeySheetBeginsWithTheStop) {
  press(Qt::Key_F1);
  auto* sheet = window->findChild<QDialog*>("shortcuts");
  ASSERT_TRUE(sheet);
  QStringList texts;
  for (const auto* label : sheet->findChildren<QLabel*>()) texts << label->text();
  for (const char* keys : {"Space  or  Esc", "F9", "Q E", "Shift"}) {
    EXPECT_EQ(texts.count(keys), 1) << keys;
  }
  sheet->close();
}

TEST_F(PlaceConsole, theStopTakesTheMouseBesideEverySheetAndMenu) {
  auto* stop = window->findChild<StopButton*>("stop_button");
  const QPoint middle = stop->mapTo(window.get(), stop->rect().center());
  const QRect place(stop->mapToGlobal(QPoint(0, 0)), stop->size());
  const auto stops = [&](const QString& beside) {
    const StopSerial before = helm.stops();
    QTest::mouseClick(window->windowHandle(), Qt::LeftButton, {}, middle);
    EXPECT_GT(helm.stops(), before) << qPrintable(beside);
  };
  stops("nothing");
  int sheets = 0, menus = 0;
  const auto* bar = window->findChild<QMenuBar*>();
  for (auto* menu : bar->actions()) {
    for (auto* action : menu->menu()->actions()) {
      const QString text = action->text();
      if (!text.endsWith("...") && text != "Keyboard shortcuts" && !text.startsWith("About P")) {
        continue;
      }
      action->trigger();
      QTest::qWait(30);
      const auto dialogs = window->findChildren<QDialog*>();
      ASSERT_EQ(dialogs.size(), 1) << qPrintable(text);
      EXPECT_FALSE(dialogs[0]->frameGeometry().intersects(place)) << qPrintable(text);
      stops(text);
      ++sheets;
    }
    // One that is as high as this small screen lies where there is room.
    if (menu->menu()->sizeHint().height() > QGuiApplication::primaryScreen()->size().height() / 2)
      continue;
    menu->menu()->popup(bar->mapToGlobal(bar->actionGeometry(menu).bottomLeft()));
    EXPECT_FALSE(menu->menu()->geometry().intersects(place)) << qPrintable(menu->text());
    stops(menu->text());
    menu->menu()->close();
    ++menus;
  }
  EXPECT_GE(sheets, 5);
  EXPECT_GE(menus, 3);
}

}  // namespace

int main(int argc, char** argv) {
  return runPlaceTests(argc, argv);
}
