#include "gui/model/held_keys.hpp"

namespace pilothouse::gui {

bool HeldKeys::certainlyUp(const Key& key, double now) {
  return !key.used || (!key.down && now - key.released_at >= kDebounce);
}

void HeldKeys::press(unsigned long code, double now) {
  Key* place = nullptr;
  for (auto& key : keys_) {
    if (key.used && key.code == code) {
      // Let go for good before: a new press, which counts again.
      if (certainlyUp(key, now)) key.spent = false;
      key.down = true;
      return;
    }
    if (!place && certainlyUp(key, now)) place = &key;
  }
  if (!place) return;  // more keys than fingers
  *place = {code, true, true, false, -1e9};
}

void HeldKeys::pressSpent(unsigned long code, double now) {
  press(code, now);
  for (auto& key : keys_) {
    if (key.used && key.code == code) key.spent = true;
  }
}

void HeldKeys::release(unsigned long code, double now) {
  for (auto& key : keys_) {
    if (!key.used || key.code != code || !key.down) continue;
    key.down = false;
    key.released_at = now;
  }
}

void HeldKeys::spend() {
  for (auto& key : keys_) key.spent = true;
}

bool HeldKeys::held(unsigned long code, double now) const {
  for (const auto& key : keys_) {
    if (key.used && key.code == code) return !key.spent && !certainlyUp(key, now);
  }
  return false;
}

bool HeldKeys::busy(double now) const {
  for (const auto& key : keys_) {
    if (!certainlyUp(key, now)) return true;
  }
  return false;
}

}  // namespace pilothouse::gui
