#pragma once

#include <QWidget>

#include <vector>

class QVBoxLayout;

namespace faintline {

class Card;
struct Scenario;

/// Page shown while nothing is open: a button to open a recording, pictures of recordings and scenes that come with the
/// program, the lessons, and the recent recordings. Nothing is computed for it.
class WelcomePage : public QWidget
{
    Q_OBJECT

public:
    /// `lessons`: list of the lessons, which becomes part of the page.
    explicit WelcomePage(QWidget *lessons, QWidget *parent = nullptr);

    void setRecent(const QStringList &paths);

signals:
    void openRequested();
    void pathChosen(const QString &path);

private:
    QLayout *buildCards(const std::vector<Scenario> &shown);

    std::vector<Card *> m_cards;
    QVBoxLayout *m_recent;
};

} // namespace faintline
