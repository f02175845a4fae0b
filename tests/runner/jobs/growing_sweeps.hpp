// Sweeps whose groups and fits grow.
#pragma once

#include <string>
#include <vector>

#include "engine/dynamics/presets.hpp"
#include "runner/sweep/job.hpp"
#include "tests/runner/sample_rows.hpp"

namespace grainsweep {

/// A group of spheres between walls, settled as `balanced`, that may have so many packings.
inline std::vector<Job> growing_group(const std::string& name, double width, int most,
                                      ErrorWish wish) {
  std::vector<Job> jobs;
  for (int replicate = 1; replicate <= most; ++replicate) {
    Job job;
    job.id = name + std::to_string(replicate);
    job.label = "MSP";
    job.parameters = sample_parameters(width, Boundary::walls, 0.0);
    job.replicate = replicate;
    job.spec.accuracy = *preset("balanced");
    job.spec.sizes.small_share = 0.0;
    job.wish = wish;
    jobs.push_back(job);
  }
  return jobs;
}

/// Three groups between walls and one without, whose fit is to be so precise.
inline Sweep fit_sweep(int most, const FitWish& wish, const std::string& name = "f") {
  Sweep whole{"s", 7, 1, {}};
  for (const double width : {4.0, 5.0, 8.0, 9.0}) {
    const bool is_walled = width < 9.0;
    for (Job& job : growing_group(name + std::to_string(static_cast<int>(width)) + "-", width,
                                  is_walled ? most : first_replicates, {})) {
      job.spec.box.width = width;
      job.spec.box.y = is_walled ? Boundary::walls : Boundary::periodic;
      std::string parameters = sample_parameters(width, job.spec.box.y, 0.0);
      job.parameters = parameters.insert(1, "\"name\":\"" + name + "\",");
      job.fit_wish = wish;
      whole.jobs.push_back(job);
    }
  }
  return whole;
}

}  // namespace grainsweep
