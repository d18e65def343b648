#pragma once

#include <QFont>
#include <QString>

namespace faintline {

/// A title such as "Frequency (Hz)" for a room of that width in pixels: whole, its unit alone, or with an ellipsis, but
/// never cut.
QString fittingTitle(const QString &title, const QFont &font, int room);
/// The same for a heading, which loses its unit first: "Input (dB)" becomes "Input".
QString fittingHeading(const QString &heading, const QFont &font, int room);

} // namespace faintline
