#pragma once

#include <memory>

namespace pilothouse::gui {

class Helm;

/// Reads the keyboard and the mouse from the X server on a connection and a thread of its own, so
/// that the stop and the release of a driving key arrive although the GUI thread is busy. Heeds
/// keys only while one of this process's windows has the focus.
class KeyWatcher {
 public:
  /// Before anything else of the process uses X.
  static void prepare();
  /// Null where there is no X server or it lacks XInput 2.
  static std::unique_ptr<KeyWatcher> open(Helm& helm);
  virtual ~KeyWatcher() = default;
  /// From now on keys count. @param window any X window of this process's toolkit.
  virtual void heed(unsigned long window) = 0;
  /// A mouse button pressed there, in that window's pixels, stops, where nothing lies over it.
  struct Place {
    int x = 0, y = 0, width = 0, height = 0;
  };
  virtual void heedPresses(Place place) = 0;
};

}  // namespace pilothouse::gui
