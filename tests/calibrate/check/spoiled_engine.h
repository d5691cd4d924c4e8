#pragma once

#include "calibrate/check/check.h"
#include "core/apparatus/impact/impact.h"
#include "tests/calibrate/slump.h"

namespace pastefit {

/// Engines with a fault put in on purpose, in the words of the fault. They call themselves what the card's engine is
/// called, unless said otherwise.
inline CheckEngine engine_of(const Card& card) {
  CheckEngine engine;
  engine.program = card.tests.at(0).baseline.program;
  engine.machine = card.tests.at(0).baseline.machine;
  return engine;
}

inline ContactModel with_bridges_of_strength(ContactModel contact, double factor) {
  contact.bridge.a_n_m2 *= factor;
  contact.bridge.b_n_m *= factor;
  contact.bridge.c_n *= factor;
  if (contact.cohesion_n) *contact.cohesion_n *= factor;
  return contact;
}

inline CheckEngine with_stronger_bridges(CheckEngine engine, double factor) {
  engine.run = of_slump([factor](SlumpTest test, const RunOptions& options) {
    test.contact = with_bridges_of_strength(test.contact, factor);
    return simulate(test, options);
  });
  engine.meet = [factor](Impact test) {
    test.contact = with_bridges_of_strength(test.contact, factor);
    return simulate(test);
  };
  return engine;
}

inline CheckEngine without_friction(CheckEngine engine) {
  engine.run = of_slump([](SlumpTest test, const RunOptions& options) {
    test.contact.friction = 0;
    return simulate(test, options);
  });
  return engine;
}

/// The plate falls twice: the engine has no second fall, so the energy of two is given to one, by twice the height.
inline CheckEngine with_plate_dropped_twice(CheckEngine engine) {
  engine.run = of_slump([](SlumpTest test, const RunOptions& options) {
    test.drop->lift_height_m *= 2;
    return simulate(test, options);
  });
  return engine;
}

/// A change of the kind that nobody would notice: the last bit of one number.
inline CheckEngine with_one_bit_changed(CheckEngine engine) {
  engine.run = of_slump([](SlumpTest test, const RunOptions& options) {
    test.contact.restitution *= 1 + 0x1p-23;  // forces have 24 bits
    return simulate(test, options);
  });
  return engine;
}

}  // namespace pastefit
