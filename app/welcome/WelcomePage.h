#pragma once

#include "app/base/JobRunner.h"

#include <QWidget>

#include <vector>

class QVBoxLayout;

namespace faintline {

class ScanCard;
class ScenarioCard;

/// Page shown while nothing is open: scenarios that are simulated and analysed in the background, a button to open a
/// recording, and the recent recordings.
class WelcomePage : public QWidget
{
    Q_OBJECT

public:
    /// `lessons`: list of the lessons, which becomes part of the page.
    explicit WelcomePage(QWidget *lessons, QWidget *parent = nullptr);

    void setRecent(const QStringList &paths);

    const std::vector<ScenarioCard *> &cards() const { return m_cards; }
    ScanCard *scanCard() const { return m_scanCard; }

public slots:
    void start(); ///< continues with the cards that are not ready yet
    void stop();  ///< frees the processor for other work

signals:
    void openRequested();
    void pathChosen(const QString &path);
    /// Emitted even if the card has no result yet.
    void scenarioChosen(faintline::ScenarioCard *card);
    void scansChosen(); ///< the radar's card
    void settled();     ///< all cards are ready
    void failed(const faintline::Error &error);

private:
    QLayout *buildCards();
    void startNext();
    void startScans();

    std::vector<ScenarioCard *> m_cards;
    ScanCard *m_scanCard;
    QVBoxLayout *m_recent;
    JobRunner m_runner; ///< destroyed first, so that its jobs end before the other members are destroyed
};

} // namespace faintline
