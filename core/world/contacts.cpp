#include "core/world/contacts.h"

#include <cmath>

namespace pastefit {

namespace {

/// Size of padding: the dummy pair sits on one spot, so it would form a bridge; this makes its energy vanish.
constexpr double kNoSize = 1e-30;

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
  const double lightness_a = particles.spin[i].inverse_mass, lightness_b = particles.spin[j].inverse_mass;
  Contact contact;
  contact.root_radius = std::sqrt(i == j ? ra : ra * rb / (ra + rb));
  contact.root_mass = std::sqrt(1 / (i == j ? lightness_a : lightness_a + lightness_b));
  return contact;
}

void ContactList::add(std::int32_t i, std::int32_t j, const Contact& contact) {
  const int lane = count % kBatch;
  ContactBatch& batch = next();
  batch.i[lane] = i;
  batch.j[lane] = j;
  batch.root_radius[lane] = contact.root_radius;
  batch.root_mass[lane] = contact.root_mass;
  for (int c = 0; c < 3; ++c) {
    batch.slip[c][lane] = contact.slip[c];
    batch.roll[c][lane] = contact.roll[c];
  }
  batch.root_contact_radius[lane] = contact.root_contact_radius;
  batch.damper[lane] = contact.damper;
  batch.drag[lane] = contact.drag;
  batch.bridge[lane] = contact.bridge;
}

void ContactList::pad(std::int32_t dummy) {
  Contact nothing;
  nothing.root_radius = std::sqrt(kNoSize);
  while (count % kBatch != 0) add(dummy, dummy, nothing);
}

Contact ContactList::contact(std::int32_t k) const {
  const ContactBatch& batch = batches[k / kBatch];
  const int lane = k % kBatch;
  Contact contact;
  contact.root_radius = batch.root_radius[lane];
  contact.root_mass = batch.root_mass[lane];
  for (int c = 0; c < 3; ++c) {
    contact.slip[c] = batch.slip[c][lane];
    contact.roll[c] = batch.roll[c][lane];
  }
  contact.root_contact_radius = batch.root_contact_radius[lane];
  contact.damper = batch.damper[lane];
  contact.drag = batch.drag[lane];
  contact.bridge = batch.bridge[lane];
  return contact;
}

void BridgeList::add(std::int32_t i, std::int32_t j, double size_scale, double alive) {
  const int lane = count % kBatch;
  BridgeBatch& batch = next();
  batch.i[lane] = i;
  batch.j[lane] = j;
  batch.size_scale[lane] = size_scale;
  batch.bridge[lane] = alive;
}

void BridgeList::pad(std::int32_t dummy) {
  while (count % kBatch != 0) add(dummy, dummy, kNoSize, 0.0);
}

}  // namespace pastefit
