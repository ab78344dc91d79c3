// Stand-in: a work item that whoever holds it runs.
#pragma once
namespace px4
{
struct wq_config_t {
};
namespace wq_configurations
{
static constexpr wq_config_t rate_ctrl{};
}
class ScheduledWorkItem
{
public:
    ScheduledWorkItem(const char *, const wq_config_t &) {}
    virtual ~ScheduledWorkItem() = default;
    void ScheduleNow()
    {
        Run();
    }

protected:
    virtual void Run() = 0;
};
} // namespace px4
