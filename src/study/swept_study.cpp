#include "study/swept_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <freestand/error.hpp>

#include "base/folder.hpp"
#include "io/fragility_file.hpp"
#include "io/h5.hpp"
#include "study/known.hpp"

namespace freestand::study {

std::int64_t swept_samples(const io::SampleReader& samples) { return samples.provenance().samples; }

std::int64_t samples_alike(const io::SampleReader& samples) {
  return samples.provenance().alike.value_or(swept_samples(samples));
}

std::int64_t rows_alike(const io::SampleReader& samples) { return std::min(samples.rows(), samples_alike(samples)); }

std::string kept_told(const io::SampleReader& samples, std::int64_t rows) {
  if (rows == swept_samples(samples)) return "";
  if (rows < samples.rows())
    return fmt::format(
        "of the {} samples of the sweep the first {} were taken whatever their intensity, and these alone answer "
        "what is asked of all intensities together, or over another one (until: {{everywhere: true}} takes more)",
        swept_samples(samples), rows);
  return fmt::format(
      "of the {} samples of the sweep the first {} are kept, and these alone answer what was not asked before it "
      "(keep: all, "
      "or {{thin: 100}}, keeps more)",
      swept_samples(samples), rows);
}

Study analysed_study(const std::filesystem::path& folder, const io::SampleReader& samples) {
  Study study = parse_stored(samples.provenance().study, samples_path(folder));
  const std::filesystem::path fitted = folder / "fragility.h5";
  if (!is_there(fitted)) return study;
  const io::Provenance provenance = io::read_provenance(io::h5::File::open(fitted).root(), io::fragility_format);
  study.fragility = parse_stored(provenance.study, fitted).fragility;
  return study;
}

Study swept_study(const parallel::Communicator& world, const std::filesystem::path& folder,
                  const io::SampleReader& samples) {
  const std::filesystem::path file = study_path(folder);
  const auto read = [&] {
    Study study = read_study(file, registries());
    const Study swept = parse_stored(samples.provenance().study, samples_path(folder));
    study.fragility = swept.fragility;  // which may be edited; the samples do not depend on it but for the intensity
    if (fingerprint(study) != fingerprint(swept))
      throw Error(
          fmt::format("{} is not the study that was swept (it was edited): undo the changes outside of "
                      "`fragility:`",
                      file.string()));
    return study;
  };
  world.on_root([&] { read(); });
  return read();
}

}  // namespace freestand::study
