#pragma once

#include <array>
#include <cstddef>

namespace pilothouse::gui {

/// Which keys are held down, freed from what X makes of a held key: it arrives as release + press
/// pairs every 40 ms, so a release counts only when no press follows within kDebounce. A key is any
/// number of the caller's. Every time is an argument: steady seconds.
class HeldKeys {
 public:
  static constexpr double kDebounce = 0.015;  ///< [s]

  void press(unsigned long key, double now);
  /// Held down, but it counts only once it was let go and pressed anew.
  void pressSpent(unsigned long key, double now);
  void release(unsigned long key, double now);
  /// What is held counts no more until it was let go and pressed anew: the window lost the focus, a
  /// stop was pressed. Releases that never arrive then do no harm.
  void spend();
  /// Held down, pressed anew since the last spend().
  bool held(unsigned long key, double now) const;
  /// A key is down or its release is not certain yet.
  bool busy(double now) const;

 private:
  struct Key {
    unsigned long code = 0;
    bool used = false;
    bool down = false;
    bool spent = false;
    double released_at = -1e9;
  };
  static bool certainlyUp(const Key& key, double now);
  std::array<Key, 16> keys_;
};

}  // namespace pilothouse::gui
