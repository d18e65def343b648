#pragma once

#include "app/base/Inquiry.h"
#include "app/base/Panel.h"
#include "exchange/writeDoppler.h"

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace faintline {

class ChartPlot;
class ColumnTable;
class Document;
class EventTable;
class Provenance;

/// Fits the pass of a source to the selected event's track: rest frequency, speed, closest range and its time with
/// their 90 % intervals, the residuals, and what the track of one sensor cannot determine.
///
/// Several selected events are treated as pieces of one pass; without a selection the strongest event is fitted.
/// Computed while visible; the newest selection wins.
class DopplerPanel : public Panel
{
    Q_OBJECT

public:
    DopplerPanel(Document &document, const EventTable &events, Provenance &provenance, QWidget *parent = nullptr);

    ChartPlot &frequencies() { return *m_frequencies; }
    ChartPlot &residuals() { return *m_residuals; }

    /// The extension selects the format: .json, or .csv with the points.
    void saveTo(const QString &path);

    QSize sizeHint() const override { return {720, 340}; }

private:
    /// Events, centre frequency, speed of propagation.
    using Asking = Inquiry<DopplerReport, std::shared_ptr<const Analysis>, std::shared_ptr<const std::vector<Event>>,
                           double, double>;

    Asking::Question question() const;
    void buildInputs();
    void connectInputs();
    void takeMedium();
    void takeCentre();
    void show();
    void ask();

    Document &m_document;
    const EventTable &m_events;
    Provenance &m_provenance;
    QFormLayout *m_form;
    QComboBox *m_medium;
    QDoubleSpinBox *m_propagation;
    QDoubleSpinBox *m_centre;     ///< shown for I/Q
    bool m_isCentreKnown = false; ///< the recording's value has been entered
    QPushButton *m_save;
    QLabel *m_sentence;
    ColumnTable *m_table;
    QLabel *m_notes;
    ChartPlot *m_frequencies;
    ChartPlot *m_residuals;
    Asking m_fit;
};

} // namespace faintline
