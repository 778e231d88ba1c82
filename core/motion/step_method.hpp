#pragma once
/// Contacts with bodies by a method of their own within a step. Internal to core/motion.

#include "core/motion/model.hpp"

namespace gambeson {

/// Throws InputError where Model::method cannot treat the cloth: key "contact.friction" where friction is more than
/// Coulomb's, "contact.method" where strain is limited, where the cloth is a structure, and as checkProjection says.
void checkMethod(const Model& model);

/// Says what persistent rows of bodies ask for under Model::method.
void prepareRows(const Model& model, double dt_s, StepWork& work);

/// solveByMethod of w.rows: w.velocity, w.warm and w.impulses.
ContactSolve solveByMethod(const Model& model, double dt_s, StepWork& work);

/// Whether what a row takes of the motion along its normal comes back: a penalty is a spring.
bool givesBack(const Model& model, const ContactRow& row);

}  // namespace gambeson
