#include <catch2/catch.hpp>

#include "calibrate/exports/lammps_deck.h"

using namespace pastefit;

TEST_CASE("the log of LAMMPS tells its name, ranks, and the processor time of all runs") {
  const LammpsLog log = read_lammps_log(
      "LAMMPS (29 Sep 2021 - Update 2)\n"
      "  1 by 4 by 1 MPI processor grid\n"
      "Step Time Atoms\n       0            0    12787\n     400         0.02    12787\n"
      "Loop time of 10 on 4 procs for 400 steps with 12787 atoms\n\n"
      "75.0% CPU use with 4 MPI tasks x no OpenMP threads\n"
      "Step Time Atoms\n     400         0.02    12787\n"
      "Loop time of 2.5 on 4 procs for 0 steps with 12787 atoms\n\n"
      "Total wall time: 0:00:13\n");
  CHECK(log.program == "LAMMPS (29 Sep 2021 - Update 2)");
  CHECK(log.copies == 1);
  CHECK(log.ranks == 4);
  CHECK(log.wall_s == 12.5);
  CHECK(log.core_s == 10 * 4 * 0.75 + 2.5 * 4);
  CHECK(log.ended);
  CHECK(log.error.empty());
}

TEST_CASE("a log that is cut short has not ended, and its first error is told") {
  const LammpsLog log = read_lammps_log("LAMMPS (1)\nERROR on proc 0: no such style\nERROR: second\nLoop time of x");
  CHECK_FALSE(log.ended);
  CHECK(log.error == "ERROR on proc 0: no such style");
  CHECK(log.ranks == 0);
  CHECK(read_lammps_log("").copies == 0);
}

TEST_CASE("a log has a slide angle where the deck has printed one, and not where it echoes the command") {
  CHECK(read_lammps_log("slide angle 18.5 degrees\n").slide_angle_deg == 18.5);
  CHECK_FALSE(read_lammps_log("print        \"slide angle $(-v_tilt*180/PI) degrees\"\n").slide_angle_deg);
}
