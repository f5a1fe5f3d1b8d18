// Interval of a probability from counts by group of motions: a record is the unit, not its samples.
#pragma once

#include <span>

#include "fragility/groups.hpp"
#include "fragility/intervals.hpp"

namespace freestand::fragility {

// Of one group: samples, and those above (or still, or overturned).
struct GroupShare {
  double n, hits;
};

// The first record_groups are groups of records, the others hold samples that are motions of their own: of these the exact binomial
// limits, and where each of these groups is a design of its own (scrambles), at least those that the designs' scatter shows, as of records
// below: samples of a design are not independent, and where an answer depends on products of what is drawn, two of them may be worth one.
// Of the share p of the n samples of records, limits in ln odds,
//   ln(p/(1 - p)) -+ t_f se/(p (1 - p)),   se^2 = sum over the G records of (e - mean e)^2 (G - 1)/G,   e = (hits - p n_g)/(n - n_g),
// e being by how much p moves where the record is left out, with the degrees of freedom f that the records show: few records that
// make most of the count tell its error badly (variance_sum.hpp). At least as far as independent samples reach.
//
// Of both together p = (n_1 p_1 + n_2 p_2)/n lies off by the root of the sum of squares of what the limits of each lie off, upper and lower
// ones apart (G. Zou & A. Donner, Statistics in Medicine 27, 2008): four records that never overturned are four, however many samples of
// pulses did not either.
//
// Where fewer than three records make the count, (sum hits)^2/(sum hits^2) < 3, their scatter has fewer than two degrees of freedom, of
// which Student's t has no variance: how many samples of a record exceed at a time is not known. Then the upper limit is at least that of
// none, since more cannot be known from fewer misses: as if each record were one sample, 1 - tail^(1/G). What of its tail the upper limit
// then does not need is the lower one's (unused_tail). Of misses and the lower limit alike. Where none or all hit, that limit alone.
// [0, 1] where no two motions have samples.
//
// p is the mean of a record's share, which is at most the probability that a record shows anything of it: the exact limit of
// the records that do, of as many as n^2/(sum n_g^2) that are alike, bounds the upper one (80 of the 100 samples of one record in ten, none of the others': 0.39 instead of 0.97).
//
// By simulation (tests/fragility/share_coverage_test.cpp: ln demand normal, a part of its variance between records; 10,000 repeats, error
// 0.003) of 25 samples a record, P = 0.1 to 0.7, correlation 0 to 0.8, intervals of 90 % hold the truth in 0.899 to 0.940 of the cases with
// 14 records, 0.902 to 0.928 with 22, 0.901 to 0.920 with 40, 0.902 to 0.915 with 100. Above 0.93 are 14 records that do not differ (0.933:
// independent samples bound the reach from below) and 14 that are nearly one sample each (0.940): a share of 14 jumps by 0.07. Exact limits
// at an effective number of samples (E. Korn & B. Graubard, Survey Methodology 24, 1998) hold it in up to 0.958 there, and with P = 0.03 in
// 0.80: of one or two records that exceed they take the error for known. Where records are drawn by weights (dispersion
// 1 and 1.5, or one of 20 with 5 to 60 times the weight of the others, which have nothing to do with what the records do; P 0.1 to 0.8,
// correlation 0.3 to 0.9) 0.86 to 0.98 with 20 records; where none hit, each record counts as one all the same. With pulses for a quarter to
// half of the samples, 2 to 44 records that are nearly all or nothing: 0.96 to 1.00. Where P times the number of records is below 1, no interval of
// counts comes near 0.90 everywhere: most studies see none, one or two records that exceed, and the limit of none holds all P below it.
// Over 120 settings (14 and 40 records; 25, 140 and 1000 samples a record; 0.1, 0.3, 0.5 and 0.8 records expected to exceed; correlation 0 to
// 0.95; error 0.004) coverage is 0.80 to 0.99: least with 40 records of 1000 samples, 0.1 of them expected and correlation 0.5 (0.796), most where
// records are all or nothing (0.95 to 0.995 at correlation 0.95). There whole records are what is counted, and an interval by their number
// holds the truth up to some number of them, so that its coverage can only be one of
//
//   records expected   up to none   up to one   up to two   (Poisson)
//   0.1                0.905        0.995       1.000
//   0.3                0.741        0.963       0.996
//   0.5                0.607        0.910       0.986
//   0.8                0.449        0.809       0.953
//
// of which none at 0.3 and at 0.8 lies in 0.87 to 0.93.
Interval share_interval(std::span<const GroupShare> groups, std::size_t record_groups, double confidence,
                        bool designs = false);
Interval share_interval(std::span<const GroupShare> groups, const MotionGroups&, double confidence);

}  // namespace freestand::fragility
