// The most likely covariance of the readings beside a linear model, for each kind of discrepancy.
//
// Noise is white, and correlated over at most `longest_memory_s`. A slower change has a cause, logged or not: it is the
// discrepancy (Kennedy and O'Hagan 2001, J. R. Stat. Soc. B 63, 425). Its size is at least 0.3 times the noise, so that
// it cannot shrink to noise; its memory lies between 25 min and three times the record. The hyperparameters are at the
// maximum of the evidence within these bounds. Each costs two nats, for its volume.
#pragma once

#include <vector>

#include "diagnosis/posterior/problem.hpp"

namespace ballbar {

enum class Discrepancy { none, rough, smooth };  // Ornstein-Uhlenbeck, Matern 3/2

Discrepancy discrepancy_of(const Covariance& covariance);

// The kinds that these readings can have.
std::vector<Discrepancy> discrepancies_of(const Problem& problem);

// start: nearby; nullptr: not known. The prior of the kind is in its log_prior.
Covariance likeliest_covariance(const Problem& problem, const LinearModel& linear, Discrepancy kind,
                                const Covariance* start = nullptr);

// Of each kind, or those that the problem has.
std::vector<Covariance> likeliest_covariances(const Problem& problem, const LinearModel& linear);

// The filter of the most likely of these.
NoiseFilter likeliest_filter(const Problem& problem, const LinearModel& linear);

}  // namespace ballbar
