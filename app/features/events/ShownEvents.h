#pragma once

#include <QObject>

namespace faintline {

class Document;
class EventTable;

/// Shows the document's events in a table, with SNRs in the bandwidth that the user has chosen.
class ShownEvents : public QObject
{
public:
    ShownEvents(Document &document, EventTable &table, QObject *parent = nullptr);

    /// Of the noise, Hz; 0: that of a bin.
    double snrBandwidth() const { return m_snrBandwidthHz; }
    void setSnrBandwidth(double hz);

private:
    void showPlan();
    void showEvents();
    void showState();

    Document &m_document;
    EventTable &m_table;
    double m_snrBandwidthHz = 0.0;
};

} // namespace faintline
