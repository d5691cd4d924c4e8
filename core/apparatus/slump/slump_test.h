#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/apparatus/dimension.h"
#include "core/apparatus/reading_kind.h"
#include "core/apparatus/specimen.h"
#include "core/observe/outline.h"
#include "core/result.h"
#include "core/step/run.h"

namespace pastefit {

/// An open frustum on the table; with the wider end on top it is an inverted cone.
struct Mould {
  double base_radius_m = 0.100;
  double top_radius_m = 0.065;
  double height_m = 0.200;
};

/// The wider and the narrower of its two ends.
double wider_radius_m(const Mould& mould);
double narrower_radius_m(const Mould& mould);

/// Inner volume of the mould [m^3]: pi h (r_b^2 + r_b r_t + r_t^2)/3.
double volume_m3(const Mould& mould);

/// How the table under a heap is dropped.
enum class TableMotion {
  hinged,   ///< a square plate rotates up about an edge and falls back (EN 12350-5)
  vertical  ///< a cam raises a round table, which falls vertically, as a jolting table does (EN 1015-3, ASTM C230)
};

/// The plate or table of a flow test, centred under the mould. Its seat stops it dead, as an infinite mass would:
/// standards mount it on blocks of a hundred kilograms or more.
/// Hinged: the hinge is the edge at x = -length/2, the free edge that at x = +length/2.
struct DropPlate {
  double length_m = 0.700;  ///< side of the square plate, diameter of the round table
  double mass_kg = 16.0;
  double lift_height_m = 0.040;  ///< rise of the free edge at the upper stop, or of the whole table
  double lift_duration_s = 0.5;  ///< duration of the rise of a hinged plate; a vertical table is raised at once
  double period_s = 2.0;         ///< from one drop to the next, if there are several
  TableMotion motion = TableMotion::hinged;
  int drops = 1;
};
inline constexpr int kMostDrops = 100;

/// Which point of the heap is its height.
enum class HeightReading {
  axis,    ///< mean over the probe disc at the displaced centre of the struck-off top (ASTM C143)
  highest  ///< the highest point of the heap (EN 12350-2)
};

/// The part of a flank on which the angle of repose is read, as shares of the heap's height: without the rounded tip
/// and the grains that rolled away at the foot.
struct Flank {
  double lower_share = 0.2, upper_share = 0.8;
};

/// Timing of the flow, from the beginning of the lift.
struct FlowTiming {
  double diameter_m = 0.5;  ///< circle whose passage gives T500 (EN 12350-8: 500 mm)
};

/// A point of a measured curve of spread against time: s and m.
using SpreadPoint = std::array<double, 2>;

/// How the heap is measured.
struct ReadingMethod {
  HeightReading height = HeightReading::axis;
  double probe_diameter_m = 0.040;
  double sag_window_m = 0.100;  ///< width of the top around the axis on which the sag after step 2 is read
  /// Measured outlines of the heap in side view along the hinge; x from the centre of the table towards the free edge.
  /// Empty: not measured.
  std::vector<OutlinePoint> outline_step1, outline_step2;
  std::optional<FlowTiming> flow;         ///< of the flow after the lift begins; empty: not timed
  std::vector<SpreadPoint> spread_curve;  ///< measured, from the beginning of the lift; empty: not measured
  std::optional<Flank> flank;             ///< for the angle of repose after step 1; empty: not read
};

/// The table is tilted with the heap of step 1 on it, until the heap slides.
struct Tilt {
  double rate_deg_s = 3;   ///< degrees per second
  double slide_m = 0.005;  ///< motion of the heap's base down the table that counts as sliding
};
inline constexpr double kSteepest = 80;  ///< [degrees] at which the tilt ends

/// The slump test: the specimen, with the density of the fresh material in the mould, and the apparatus. The density of
/// a grain follows from the packing.
/// Step 1: fill, strike off, lift the mould. Step 2 (only if `drop` is set): raise the plate and drop it, once or
/// several times. Tilt (only if `tilt` is set): the heap of step 1 is tilted until it slides.
struct SlumpTest : Specimen {
  Mould mould;
  double lift_velocity_m_s = 0.1;
  double table_length_m = 0.700;  ///< side of the square table and of the plate
  std::optional<DropPlate> drop;
  std::optional<Tilt> tilt;  ///< not together with `drop`
  ReadingMethod reading;

  WallContact mould_wall{1e9, 0.3, 0.3, 0.1, 0.0, 0.0};
  WallContact table_wall{1e9, 0.3, 0.3, 0.5, 0.1, 0.0};
};

/// Fall time of the empty plate from its upper stop to its seat [s]; a heap on it has little effect.
/// Vertical: sqrt(2 h/g). Hinged, as a rod about its end: sqrt(2 L asin(h/L)/(1.5 g)).
/// Requirement: the lift height is at most the length.
double fall_time_s(const DropPlate& plate);

/// Duration of one drop, rise and fall [s].
double moving_time_s(const DropPlate& plate);

inline constexpr std::array<Dimension<Mould>, 3> mould_dimensions{{
    {"base_radius_m", &Mould::base_radius_m, 1e-3, 2, "inner size of the mould at the bottom"},
    {"top_radius_m", &Mould::top_radius_m, 1e-3, 2,
     "inner size of the mould at the top; for an inverted cone, it is larger than at the bottom"},
    {"height_m", &Mould::height_m, 1e-3, 2, "height of the mould"},
}};
inline constexpr std::array<Dimension<SlumpTest>, 2> slump_dimensions{{
    {"table_length_m", &SlumpTest::table_length_m, 2e-3, 10, "side length of the square table under the mould"},
    {"lift_velocity_m_s", &SlumpTest::lift_velocity_m_s, 1e-3, 5, "speed at which the mould is lifted vertically",
     false, true},
}};
inline constexpr std::array<Dimension<DropPlate>, 4> plate_dimensions{{
    {"length_m", &DropPlate::length_m, 2e-3, 10, "side length of a square plate, or diameter of a round table"},
    {"mass_kg", &DropPlate::mass_kg, 0.1, 1000, "mass of the plate without the heap"},
    {"lift_height_m", &DropPlate::lift_height_m, 1e-4, 1,
     "rise of the free edge of a hinged plate, or of the whole round table, before the drop"},
    {"lift_duration_s", &DropPlate::lift_duration_s, 0.01, 60, "time in which a hinged plate is raised; default 0.5",
     true},
}};
inline constexpr std::array<Dimension<DropPlate>, 1> rhythm_dimensions{{
    {"period_s", &DropPlate::period_s, 0.02, 60, "time from one drop to the next, if there are several; default 2",
     true},
}};
inline constexpr std::array<Dimension<ReadingMethod>, 2> reading_dimensions{{
    {"probe_diameter_m", &ReadingMethod::probe_diameter_m, 1e-6, 4,
     "diameter of the disc over which a height at the axis is averaged", true},
    {"sag_window_m", &ReadingMethod::sag_window_m, 1e-6, 10,
     "width, centred on the axis, over which the sag of the plateau is read", true},
}};
inline constexpr std::array<Dimension<FlowTiming>, 1> flow_dimensions{{
    {"diameter_m", &FlowTiming::diameter_m, 2e-3, 10, "spread that is reached at the time step1.t500_s; default 500",
     true},
}};
inline constexpr std::array<Dimension<Tilt>, 2> tilt_dimensions{{
    {"rate_deg_s", &Tilt::rate_deg_s, 0.1, 45, "angular speed of the tilting table; default 3", true},
    {"slide_m", &Tilt::slide_m, 1e-4, 1, "motion of the heap's base down the table that counts as sliding; default 5",
     true},
}};
inline constexpr std::array<Dimension<Flank>, 2> flank_dimensions{{
    {"lower_share", &Flank::lower_share, 0, 0.9,
     "lower end of the part that is read, as a share of the heap's height; default 0.2", true},
    {"upper_share", &Flank::upper_share, 0.1, 1,
     "upper end of the part that is read, as a share of the heap's height; default 0.8", true},
}};

/// Returns the reasons why the test cannot run (dimensions, ranges, inadmissible bridge, too few grains in the mould);
/// empty if it can. Places are field paths, e.g. "contact.bridge.d_c_m".
Faults validate(const SlumpTest& test);

/// Runs the slump test. Same test, options and program: same bits.
/// Requirements: `validate(test)` is empty; a cutoff refers to `step1.height_mm`. Errors: bad physics is reported in
/// `Outcome::failure`, never thrown.
Outcome simulate(const SlumpTest& test, const RunOptions& options = {});

/// Names of all readings of this test, in order (with or without step 2).
std::vector<std::string> reading_names(const SlumpTest& test);

/// Stages of a slump test.
inline constexpr int kFill = 0, kStep1 = 1, kStep2 = 2, kAfterDrops = 3, kTilt = 4;

/// True if the apparatus requests a reading that is taken on request only (`ReadingKind::on_request`).
bool is_asked_for(const SlumpTest& test, std::string_view reading);

/// All readings of slump tests, in the order of the simulation; those that this test cannot give have a `lack`.
std::vector<ReadingKind> reading_kinds(const SlumpTest& test);

}  // namespace pastefit
