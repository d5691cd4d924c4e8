#include "core/world/contacts.h"

#include <cmath>

namespace pastefit {

namespace {

/// Size of padding: the dummy pair sits on one spot, so it would form a bridge; this makes its energy vanish.
constexpr float kNoSize = 1e-12F;

}  // namespace

Contact Contact::turned() const {
  Contact other = *this;
  for (int c = 0; c < 3; ++c) {
    other.slip[c] *= -1;
    other.roll[c] *= -1;
  }
  return other;
}

Contact new_contact(const Particles& particles, std::int32_t i, std::int32_t j) {
  const double ra = particles.motion[i].radius, rb = particles.motion[j].radius;
  const double lightness_a = particles.velocity[i].inverse_mass, lightness_b = particles.velocity[j].inverse_mass;
  Contact contact;
  contact.sqrt_radius = static_cast<float>(std::sqrt(i == j ? ra : ra * rb / (ra + rb)));
  contact.sqrt_mass = static_cast<float>(std::sqrt(1 / (i == j ? lightness_a : lightness_a + lightness_b)));
  return contact;
}

void ContactList::pad(std::int32_t dummy) {
  Contact nothing;
  nothing.sqrt_radius = std::sqrt(kNoSize);
  while (count % kBatch != 0) add(dummy, dummy, nothing);
}

void BridgeList::pad(std::int32_t dummy) {
  while (count % kBatch != 0) add(dummy, dummy, kNoSize, 0);
}

}  // namespace pastefit
