#include "io/database_columns.hpp"

namespace freestand::io {
namespace {

using database::Curve;
using database::Entry;
using database::Point;

// clang-format off
constexpr DatabaseColumn<Entry> entries[] = {
  {"id", "", "name of the entry", &Entry::id},
  {"class", "", "class of equipment", &Entry::equipment},
  {"floor", "", "floor that it stands on, as the catalogue names it", &Entry::floor},
  {"friction", "", "friction under it, as the catalogue names it", &Entry::friction},
  {"description", "", "what it is", &Entry::description},
  {"source", "", "where its numbers come from", &Entry::source},
  {"width_m", "m", "width between its outer edges; as all of its numbers the median, where it is drawn", &Entry::width_m},
  {"height_m", "m", "height", &Entry::height_m},
  {"mass_kg", "kg", "mass", &Entry::mass_kg},
  {"mu_k", "1", "kinetic friction", &Entry::mu_k},
  {"mu_s", "1", "static friction", &Entry::mu_s},
  {"model", "", "model of the block", &Entry::model},
  {"effects", "", "physical effects beyond the plain block", &Entry::effects},
  {"shaking", "", "hash of the motions: entries with the same one were shaken alike", &Entry::shaking},
  {"scatter", "", "what is drawn from a distribution, with its 84 % point over its median", &Entry::scatter},
  {"reference_source", "", "where another fragility of the same equipment comes from", &Entry::reference_source},
  {"reference_id", "", "its name there", &Entry::reference_id},
  {"reference_intensity", "", "its intensity", &Entry::reference_im},
  {"reference_demand", "", "its demand", &Entry::reference_demand},
  {"reference_capacity", "1", "its capacity, in the unit of the demand", &Entry::reference_capacity},
  {"reference_median", "1", "its median, in the unit of the intensity", &Entry::reference_median},
  {"reference_dispersion", "1", "its dispersion", &Entry::reference_dispersion},
  {"samples", "1", "samples computed", &Entry::samples},
  {"failed", "1", "samples without a result, in none of the curves", &Entry::failed},
  {"motions", "1", "groups of floor motions, the unit of all bands", &Entry::motions},
  {"seed", "1", "seed of the draws", &Entry::seed},
  {"version", "1", "raised whenever the entry is computed anew from another study", &Entry::version},
  {"fingerprint", "", "hash of the study", &Entry::fingerprint},
  {"kernel", "", "number of the kernel that made the samples", &Entry::kernel},
  {"program", "", "version of freestand", &Entry::program},
  {"git_commit", "", "its commit", &Entry::git_commit},
  {"created_utc", "", "when", &Entry::created_utc},
  {"study", "", "the study, every default written out", &Entry::study},
};

constexpr DatabaseColumn<Curve> curves[] = {
  {"intensity", "", "intensity measure", &Curve::im},
  {"demand", "", "demand parameter", &Curve::demand},
  {"capacity", "1", "in the unit of the demand; 0.5 of one that happens or not", &Curve::capacity},
  {"n", "1", "samples", &Curve::n},
  {"im_least", "1", "least intensity swept", &Curve::im_least},
  {"im_most", "1", "greatest intensity swept", &Curve::im_most},
  {"family", "", "how it is to be read: lognormal, by median and dispersion; points and not_refuted, by its points", &Curve::family},
  {"median", "1", "intensity at which the lognormal is 1/2", &Curve::median},
  {"dispersion", "1", "standard deviation of ln IM", &Curve::dispersion},
  {"median_se", "1", "standard error of the median, from resampled motions", &Curve::median_se},
  {"dispersion_se", "1", "standard error of the dispersion, from resampled motions", &Curve::dispersion_se},
  {"extrapolated", "1", "1: the median lies outside of what was swept", &Curve::extrapolated},
  {"misfit", "1", "largest difference between the lognormal and the counted shares", &Curve::misfit},
  {"misfit_im", "1", "intensity where it is", &Curve::misfit_im},
  {"misfit_p", "1", "chance of a larger one if the lognormal were true", &Curve::misfit_p},
  {"off_by", "1", "the true shares of bins of IM are off the lognormal by no more; within a bin it may be more", &Curve::off_by},
};

constexpr DatabaseColumn<Point> points[] = {
  {"im", "1", "mean intensity of the samples of a bin", &Point::im},
  {"probability", "1", "P(demand > capacity)", &Point::probability},
  {"lower", "1", "lower end of the band, from resampled motions", &Point::lower},
  {"upper", "1", "upper end of the band, from resampled motions", &Point::upper},
  {"n", "1", "samples of the bin", &Point::n},
};
// clang-format on

}  // namespace

std::span<const DatabaseColumn<Entry>> entry_columns() { return entries; }
std::span<const DatabaseColumn<Curve>> curve_columns() { return curves; }
std::span<const DatabaseColumn<Point>> point_columns() { return points; }

}  // namespace freestand::io
