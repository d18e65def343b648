#pragma once

#include "app/document/AnalysisController.h"
#include "app/features/events/Comparer.h"

#include <QWidget>

class QLabel;
class QPushButton;
class QToolButton;

namespace faintline {

class ColumnTable;
class WaterfallView;

/// A against B: the difference of their statistics on the common viewport, the events found by both or by only one, the
/// settings in which they differ, and the cost of each. A click on a row goes to the event.
class ComparePanel : public QWidget
{
    Q_OBJECT

public:
    ComparePanel(Document &document, AnalysisController &controller, Comparer &comparer, QWidget *parent = nullptr);

    WaterfallView *picture() const { return m_picture; }

    QSize sizeHint() const override { return {900, 300}; }

public slots:
    void keep(); ///< makes the current result A
    void swap();
    void goToA();

signals:
    void eventActivated(int id); ///< event of the document's own analysis

protected:
    void showEvent(QShowEvent *event) override;
    void hideEvent(QHideEvent *event) override;
    void changeEvent(QEvent *event) override;

private:
    QWidget *buildPicture();
    QWidget *buildWords();
    QWidget *buildList();
    QWidget *buildButtons();
    void buildTable();
    void follow();
    void showPicture();
    void showEvents();
    void showWords();
    void updateButtons();
    void goTo(const QModelIndex &index);
    QString costText() const;
    std::vector<Track> tracksAlone(const Comparer::Result &result) const;

    Document &m_document;
    AnalysisController &m_controller;
    Comparer &m_comparer;
    WaterfallView *m_picture;
    QWidget *m_picturePane;
    QLabel *m_sentence;
    QLabel *m_differences;
    QPushButton *m_keep;
    QPushButton *m_swap;
    QPushButton *m_goTo;
    QPushButton *m_compute;
    QToolButton *m_filters[3]; ///< A, B, both
    ColumnTable *m_table;
    std::vector<const ComparedEvent *> m_listed; ///< of the result, in the table
};

} // namespace faintline
