// What both of OpenQuake's formats share: its intensities, its identifiers, its XML.
#pragma once

#include <string>
#include <vector>

#include "exports/model.hpp"

namespace freestand::exports::openquake {

// The sentence on whose motion the intensity is.
std::vector<std::string> notes_on(const Model&);

// OpenQuake's name of an intensity, and how much one of freestand's unit is in OpenQuake's (g, cm/s, cm).
struct Imt {
  std::string name;
  double factor;
};

// Throws Error (Exit::usage) for an intensity that OpenQuake has no name for.
Imt imt_of(const Intensity&);

// Throws Error for an intensity, identifier or description that OpenQuake refuses.
void refuse(const Model&);
void refuse_loss_category(const Model&, bool of_vulnerability);

// The text of an attribute or element, escaped.
std::string escaped(const std::string& text);

// The file with its outer element; `body` indented by four.
std::string document(const std::string& body);

// Nodes of all curves above 0, in freestand's unit. A lognormal is given nodes so that straight lines between them are off
// by at most 2e-7.
std::vector<double> levels(const std::vector<LimitState>& states, double im_most);

// "0.1 0.2 0.3", each number as short as reads back to the same bits.
std::string numbers(const std::vector<double>& values);

}  // namespace freestand::exports::openquake
