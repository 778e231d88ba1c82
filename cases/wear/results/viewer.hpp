#pragma once
/// A recording as the viewer of a page shows it.

#include <string>

#include "analysis/report/report.hpp"
#include "analysis/viewer/viewer.hpp"
#include "cases/wear/results/measure.hpp"

namespace gambeson {

/// What of a run a viewer holds: all, or of several side by side what compares them.
enum class ViewerContent { whole, compared };

/// Bodies and garments in every frame of the motion as animations have them (animationOf), what pictures show of the
/// cloth, strain along the threads, the gap to the nearest body, the body's pressure as comfort goes by it, and contact
/// forces. Measured with its stretch and comfort. Throws RunError where nothing was recorded.
ViewerRun viewerRun(const Scenario& scenario, const RecordingReader& recording, const Measured& measured,
                    const std::string& label, ViewerContent content);

/// Unless the case wants none; a recording that cannot be shown leaves a warning.
void addViewer(const Scenario& scenario, const RecordingReader& recording, const Measured& measured, ReportInput& in);

}  // namespace gambeson
