#include "gui/model/key_watcher.hpp"

#ifdef PILOTHOUSE_X11
#include <poll.h>

#include <atomic>
#include <iterator>
#include <map>
#include <optional>
#include <thread>

#include "gui/model/guarded.hpp"
#include "gui/model/helm.hpp"
#include "gui/model/key_symbols.hpp"
// Last, for their macros. Xlibint: nothing else tells the mask of a client's ids.
#include <X11/XKBlib.h>
#include <X11/Xlib.h>
#include <X11/Xlibint.h>
#include <X11/extensions/XInput2.h>
#include <X11/keysym.h>
#undef min
#undef max
#endif

namespace pilothouse::gui {

#ifdef PILOTHOUSE_X11

namespace {

std::optional<KeyMeaning> meaningOf(KeySym symbol) {
  switch (symbol) {
    case XK_w:
      return KeyMeaning{DriveKey::kForward, 0};
    case XK_Up:
      return KeyMeaning{DriveKey::kForward, 1};
    case XK_s:
      return KeyMeaning{DriveKey::kBack, 0};
    case XK_Down:
      return KeyMeaning{DriveKey::kBack, 1};
    case XK_a:
      return KeyMeaning{DriveKey::kTurnLeft, 0};
    case XK_Left:
      return KeyMeaning{DriveKey::kTurnLeft, 1};
    case XK_d:
      return KeyMeaning{DriveKey::kTurnRight, 0};
    case XK_Right:
      return KeyMeaning{DriveKey::kTurnRight, 1};
    case XK_q:
      return KeyMeaning{DriveKey::kSideLeft, 0};
    case XK_e:
      return KeyMeaning{DriveKey::kSideRight, 0};
    case XK_Shift_L:
      return KeyMeaning{DriveKey::kSlow, 0};
    case XK_Shift_R:
      return KeyMeaning{DriveKey::kSlow, 1};
    default:
      return std::nullopt;
  }
}

class XKeyWatcher : public KeyWatcher {
 public:
  XKeyWatcher(Helm& helm, Display* display, int opcode)
      : helm_(helm), display_(display), opcode_(opcode) {
    thread_ = std::thread([this] { run(); });
  }
  ~XKeyWatcher() override {
    ending_ = true;
    thread_.join();
    XCloseDisplay(display_);
  }
  void heed(unsigned long window) override { window_ = window; }
  void heedPresses(Place place) override { stop_.set(place); }

 private:
  static constexpr int kIdle = 50;      // ms between looks whether the end has come
  static constexpr int kWithKeys = 15;  // ms between looks at the focus while keys are held

  void run() {
    while (!ending_) {
      pollfd ready{ConnectionNumber(display_), POLLIN, 0};
      if (XPending(display_) == 0) poll(&ready, 1, held_.empty() ? kIdle : kWithKeys);
      while (XPending(display_) > 0) take();
      if (held_.empty()) continue;
      helm_.setFocused(ours());
      findLostReleases();
    }
  }

  void take() {
    XEvent event;
    XNextEvent(display_, &event);
    if (event.type == MappingNotify) XRefreshKeyboardMapping(&event.xmapping);
    auto& cookie = event.xcookie;
    if (cookie.type != GenericEvent || cookie.extension != opcode_) return;
    if (!XGetEventData(display_, &cookie)) return;
    const auto* key = static_cast<const XIRawEvent*>(cookie.data);
    if (cookie.evtype == XI_RawButtonPress && key->detail == Button1 && onTheStop()) helm_.stop();
    const auto code = static_cast<KeyCode>(key->detail);
    if (cookie.evtype == XI_RawKeyPress) {
      pressed(code, symbolOf(code));
    } else if (cookie.evtype == XI_RawKeyRelease) {
      released(code);
    }
    XFreeEventData(display_, &cookie);
  }

  KeySym symbolOf(KeyCode code) {
    XkbStateRec state{};
    XkbGetState(display_, XkbUseCoreKbd, &state);
    KeySymbols symbols{};
    for (unsigned group = 0; group < symbols.size(); ++group) {
      symbols[group] = XkbKeycodeToKeysym(display_, code, group, 0);
    }
    return symbolIn(symbols, state.group);
  }

  void pressed(KeyCode code, KeySym symbol) {
    const auto meaning = meaningOf(symbol);
    const bool stops = symbol == XK_space || symbol == XK_Escape;
    if (!meaning && !stops) return;
    const bool focused = ours();
    helm_.setFocused(focused);
    if (!focused) return;
    if (stops) helm_.stop();
    if (!meaning || isShortcut()) return;
    // A key that is held keeps its meaning, whatever the layout is by now.
    helm_.press(held_.emplace(code, *meaning).first->second);
  }

  // Heeded wherever the focus is: a release is never wrong.
  void released(KeyCode code) {
    const auto key = held_.find(code);
    if (key == held_.end()) return;
    helm_.letGo(key->second);
    held_.erase(key);
  }

  void findLostReleases() {
    char down[32];
    XQueryKeymap(display_, down);
    for (auto key = held_.begin(); key != held_.end();) {
      const auto next = std::next(key);
      if (!(down[key->first / 8] & (1 << (key->first % 8)))) released(key->first);
      key = next;
    }
  }

  // The window that lies uppermost under the pointer must be the one that has the stop.
  bool onTheStop() {
    const Place stop = stop_.get();
    Window at = DefaultRootWindow(display_), root = None, child = None;
    int root_x = 0, root_y = 0, x = 0, y = 0;
    unsigned state = 0;
    while (at != None) {
      child = None;
      if (!XQueryPointer(display_, at, &root, &child, &root_x, &root_y, &x, &y, &state))
        return false;
      if (at == window_) break;
      at = child;
    }
    return at != None && x >= stop.x && y >= stop.y && x < stop.x + stop.width &&
           y < stop.y + stop.height;
  }

  bool isShortcut() {
    XkbStateRec state{};
    XkbGetState(display_, XkbUseCoreKbd, &state);
    return (state.mods & (ControlMask | Mod1Mask | Mod4Mask)) != 0;
  }

  // All windows of one client carry its base in their ids.
  bool ours() {
    Window focus = None;
    int revert = 0;
    XGetInputFocus(display_, &focus, &revert);
    const unsigned long own = display_->resource_mask;
    return window_ != 0 && focus > PointerRoot && (focus & ~own) == (window_ & ~own);
  }

  Helm& helm_;
  Display* display_;
  int opcode_;
  std::atomic<unsigned long> window_{0};
  Guarded<Place> stop_;
  std::map<KeyCode, KeyMeaning> held_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace

void KeyWatcher::prepare() {
  XInitThreads();
}

std::unique_ptr<KeyWatcher> KeyWatcher::open(Helm& helm) {
  Display* display = XOpenDisplay(nullptr);
  if (!display) return nullptr;
  int opcode = 0, event = 0, error = 0, major = 2, minor = 1;
  if (!XQueryExtension(display, "XInputExtension", &opcode, &event, &error) ||
      XIQueryVersion(display, &major, &minor) != Success) {
    XCloseDisplay(display);
    return nullptr;
  }
  unsigned char bits[XIMaskLen(XI_RawButtonPress)] = {};
  XISetMask(bits, XI_RawKeyPress);
  XISetMask(bits, XI_RawKeyRelease);
  XISetMask(bits, XI_RawButtonPress);
  XIEventMask mask{XIAllMasterDevices, static_cast<int>(sizeof bits), bits};
  XISelectEvents(display, DefaultRootWindow(display), &mask, 1);
  XFlush(display);
  return std::make_unique<XKeyWatcher>(helm, display, opcode);
}

#else

void KeyWatcher::prepare() {}

std::unique_ptr<KeyWatcher> KeyWatcher::open(Helm&) {
  return nullptr;
}

#endif

}  // namespace pilothouse::gui
