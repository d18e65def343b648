#pragma once

#include "app/base/JobRunner.h"

#include <QWidget>

#include <vector>

class QVBoxLayout;

namespace faintline {

class ScanCard;
class ScenarioCard;

/// What there is to see before anything is open: scenarios that are simulated and analysed while one looks, a way to
/// open a recording, and the latest ones.
class WelcomePage : public QWidget
{
    Q_OBJECT

public:
    /// `lessons`: their list, which becomes a part of the page.
    explicit WelcomePage(QWidget *lessons, QWidget *parent = nullptr);

    void setRecent(const QStringList &paths);

    const std::vector<ScenarioCard *> &cards() const { return m_cards; }
    ScanCard *scanCard() const { return m_scanCard; }

public slots:
    void start(); ///< goes on with the cards that are not ready yet
    void stop();  ///< leaves the machine to others

signals:
    void openRequested();
    void pathChosen(const QString &path);
    /// The card may have its result already.
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
    JobRunner m_runner; ///< last, so that its jobs end first
};

} // namespace faintline
