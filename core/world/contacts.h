#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "core/world/batches.h"
#include "core/world/neighbour_list.h"
#include "core/world/particles.h"

namespace pastefit {

/// A contact copied out of its batch; its history is zero for a new pair.
struct Contact {
  float sqrt_radius = 0, sqrt_mass = 1;
  float slip[3] = {}, roll[3] = {};
  float sqrt_contact_radius = 0, damper = 0, drag = 0, bond = 0;

  /// The same seen from the other grain: vectors change sign.
  Contact turned() const;
};

/// Padding of a list.
Contact padding();

/// A new pair of grains, or (i = j) of a grain and a wall.
Contact new_contact(const Particles& particles, std::int32_t i, std::int32_t j);

/// A list of batches that is filled pair by pair; it keeps its memory when cleared, so that a steady scene allocates
/// nothing.
template <class Batch>
class BatchList {
 public:
  Column<Batch> batches;
  std::int32_t count = 0;  ///< pairs, including padding once it is added

  void clear() { count = 0; }
  /// Becomes the concatenation of these padded lists. Allocates little more than needed, and frees a buffer that is too
  /// short first: lists are long, and each block has one.
  void join(std::initializer_list<const BatchList*> parts) {
    count = 0;
    for (const BatchList* part : parts) count += part->batch_count() * kBatch;
    const auto needed = static_cast<std::size_t>(batch_count());
    if (needed > batches.capacity()) {
      batches = {};
      batches.reserve(needed + needed / 32);
    }
    batches.clear();
    for (const BatchList* part : parts)
      batches.insert(batches.end(), part->batches.begin(), part->batches.begin() + part->batch_count());
  }
  /// Drops batches that only keep memory.
  template <class Archive>
  void serialize(Archive& archive) {
    batches.resize(static_cast<std::size_t>(batch_count()));
    archive(batches, count);
  }
  void reserve(std::int32_t pairs) { batches.reserve((pairs + kBatch - 1) / kBatch); }
  std::int32_t batch_count() const { return (count + kBatch - 1) / kBatch; }

 protected:
  /// The batch of one more pair, which becomes pair `count - 1`.
  Batch& next() {
    const auto batch = static_cast<std::size_t>(count++ / kBatch);
    if (batch == batches.capacity()) batches.reserve(batch + batch / 8 + 8);
    if (batch == batches.size()) batches.emplace_back();
    return batches[batch];
  }
};

/// A pair selected for a list, and the place of its history: `place` in the list that contained it until now; new
/// contacts have `-1 - place`.
struct ChosenPair {
  std::int32_t i;
  NeighbourList::Pair other;  ///< as stored until now
  std::int32_t place;
};

/// Contacts: first those that touched at selection, then from `near` on those that may touch.
class ContactList : public BatchList<ContactBatch> {
 public:
  std::int32_t near = 0;  ///< a multiple of kBatch, as `count` is of a padded list

  void add(std::int32_t i, std::int32_t j, const Contact& contact);
  /// Adds the pairs, and padding after them. Requirement: the list is padded. `fresh`: the new contacts, of which the
  /// first is for the padding.
  void add(std::span<const ChosenPair> pairs, const ContactList& before, const ContactList& fresh, std::int32_t dummy);
  void pad(std::int32_t dummy);
  template <class Archive>
  void serialize(Archive& archive) {
    BatchList::serialize(archive);
    archive(near);
  }
  Contact contact(std::int32_t k) const;
  std::int32_t first(std::int32_t k) const { return batches[k / kBatch].i[k % kBatch]; }
  std::int32_t second(std::int32_t k) const { return batches[k / kBatch].j[k % kBatch]; }
  float sqrt_radius(std::int32_t k) const { return batches[k / kBatch].sqrt_radius[k % kBatch]; }
  float bond(std::int32_t k) const { return batches[k / kBatch].bond[k % kBatch]; }
  bool touched(std::int32_t k) const { return batches[k / kBatch].sqrt_contact_radius[k % kBatch] > 0; }
  /// True if it has a history.
  bool remembers(std::int32_t k) const { return touched(k) || bond(k) > 0; }
};

class BridgeList : public BatchList<BridgeBatch> {
 public:
  void add(std::int32_t i, std::int32_t j, float size_scale, float alive);
  void pad(std::int32_t dummy);
  std::int32_t first(std::int32_t k) const { return batches[k / kBatch].i[k % kBatch]; }
  std::int32_t second(std::int32_t k) const { return batches[k / kBatch].j[k % kBatch]; }
  float bond(std::int32_t k) const { return batches[k / kBatch].bond[k % kBatch]; }
};

// Inlined: every selection copies each contact from one list to another.

inline void ContactList::add(std::int32_t i, std::int32_t j, const Contact& contact) {
  const int lane = count % kBatch;
  ContactBatch& batch = next();
  batch.i[lane] = i;
  batch.j[lane] = j;
  batch.sqrt_radius[lane] = contact.sqrt_radius;
  batch.sqrt_mass[lane] = contact.sqrt_mass;
  for (int c = 0; c < 3; ++c) {
    batch.slip[c][lane] = contact.slip[c];
    batch.roll[c][lane] = contact.roll[c];
  }
  batch.sqrt_contact_radius[lane] = contact.sqrt_contact_radius;
  batch.damper[lane] = contact.damper;
  batch.drag[lane] = contact.drag;
  batch.bond[lane] = contact.bond;
}

inline Contact ContactList::contact(std::int32_t k) const {
  const ContactBatch& batch = batches[k / kBatch];
  const int lane = k % kBatch;
  Contact contact;
  contact.sqrt_radius = batch.sqrt_radius[lane];
  contact.sqrt_mass = batch.sqrt_mass[lane];
  for (int c = 0; c < 3; ++c) {
    contact.slip[c] = batch.slip[c][lane];
    contact.roll[c] = batch.roll[c][lane];
  }
  contact.sqrt_contact_radius = batch.sqrt_contact_radius[lane];
  contact.damper = batch.damper[lane];
  contact.drag = batch.drag[lane];
  contact.bond = batch.bond[lane];
  return contact;
}

inline void BridgeList::add(std::int32_t i, std::int32_t j, float size_scale, float alive) {
  const int lane = count % kBatch;
  BridgeBatch& batch = next();
  batch.i[lane] = i;
  batch.j[lane] = j;
  batch.size_scale[lane] = size_scale;
  batch.bond[lane] = alive;
}

}  // namespace pastefit
