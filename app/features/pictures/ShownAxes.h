#pragma once

#include "app/features/pictures/AxesBar.h"

#include <string>

namespace faintline {

class Document;
class PingViewports;
struct ViewState;

/// Which two axes of a document's frames the maps show, and what of the others: their maxima, or a cut at the cursor.
class ShownAxes : public QObject
{
    Q_OBJECT

public:
    ShownAxes(Document &document, PingViewports &viewports, QObject *parent = nullptr);

    AxesBar &bar() { return *m_bar; } ///< sets them

    /// Throws Error if the grid does not have both, or if they are the same.
    void set(std::size_t along, std::size_t across);
    /// By their names, as on the command line.
    void set(const std::vector<std::string> &names);
    /// Whether hidden axes are cut at the cursor; otherwise their maxima are shown.
    bool isSliced() const { return m_isSliced; }
    void setSliced(bool isSliced);
    void forgetSlice() { m_isSliced = false; } ///< of another recording; emits nothing

    /// Can be seen from above, or from the side: a distance, and an angle in degrees.
    bool isPolarPossible() const;
    /// Cuts hidden axes at the cursor, or none, and shows it in the bar; returns whether the cut is another one.
    bool followPlace();
    /// Where maxima are shown, moves the cursor to the cell behind it that has the largest D.
    void goBehind();
    /// Of a session of frames on more than two axes; ignored if it does not fit these frames.
    void restore(const ViewState &view);

signals:
    void axesChanged();
    void slicedChanged();

private:
    void goToCell(std::size_t axis, Index cell);

    Document &m_document;
    PingViewports &m_viewports;
    AxesBar *m_bar;
    bool m_isSliced = false;
};

} // namespace faintline
