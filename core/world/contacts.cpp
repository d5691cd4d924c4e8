#include "core/world/contacts.h"

#include <cmath>
#include <cstddef>

namespace pastefit {

namespace {

/// Size of padding: the dummy pair has zero distance and would form a bridge; this makes its energy vanish.
constexpr float kNoSize = 1e-12F;

/// Rows of numbers in a batch, in sequence from `sqrt_radius` on.
constexpr int kRows = (sizeof(ContactBatch) - offsetof(ContactBatch, sqrt_radius)) / sizeof(float[kBatch]);

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

/// Row by row, so that neighbouring values are written together.
void ContactList::add(std::span<const ChosenPair> pairs, const ContactList& before, const ContactList& fresh,
                      std::int32_t dummy) {
  const ChosenPair kNone{0, NeighbourList::Pair(0), -1};
  for (std::size_t first = 0; first < pairs.size(); first += kBatch) {
    ContactBatch& batch = next();
    count += kBatch - 1;
    const float* from[kBatch];
    for (int lane = 0; lane < kBatch; ++lane) {
      const bool padded = first + lane >= pairs.size();
      const ChosenPair& pair = padded ? kNone : pairs[first + lane];
      batch.i[lane] = padded ? dummy : pair.i;
      batch.j[lane] = padded ? dummy : pair.other.grain();
      const ContactList& list = pair.place < 0 ? fresh : before;
      const std::int32_t place = pair.place < 0 ? -1 - pair.place : pair.place;
      from[lane] = list.batches[place / kBatch].sqrt_radius + place % kBatch;
    }
    float* const to = batch.sqrt_radius;
    for (int row = 0; row < kRows; ++row)
      for (int lane = 0; lane < kBatch; ++lane) to[row * kBatch + lane] = from[lane][row * kBatch];
  }
}

Contact padding() {
  Contact nothing;
  nothing.sqrt_radius = std::sqrt(kNoSize);
  return nothing;
}

void ContactList::pad(std::int32_t dummy) {
  while (count % kBatch != 0) add(dummy, dummy, padding());
}

void BridgeList::pad(std::int32_t dummy) {
  while (count % kBatch != 0) add(dummy, dummy, kNoSize, 0);
}

}  // namespace pastefit
