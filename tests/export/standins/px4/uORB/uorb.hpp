// Stand-in: one message of each topic, published and read by value; a callback runs what registered it.
#pragma once
#include <px4_platform_common/px4_work_queue/ScheduledWorkItem.hpp>
#include <uORB/topics/topics.hpp>

namespace standin
{
template <typename Message> struct Topic {
    static Message message;
    static bool given;
};
template <typename Message> Message Topic<Message>::message{};
template <typename Message> bool Topic<Message>::given = false;
enum class Id {
    vehicle_local_position, vehicle_attitude, vehicle_angular_velocity, debug_array, debug_key_value, trajectory_setpoint,
    actuator_motors
};
} // namespace standin
#define ORB_ID(topic) standin::Id::topic

namespace uORB
{
class Subscription
{
public:
    explicit Subscription(standin::Id) {}
    template <typename Message> bool copy(Message *to)
    {
        *to = standin::Topic<Message>::message;
        return standin::Topic<Message>::given;
    }
    template <typename Message> bool update(Message *to)
    {
        return copy(to);
    }
};
class SubscriptionCallbackWorkItem : public Subscription
{
public:
    SubscriptionCallbackWorkItem(px4::ScheduledWorkItem *, standin::Id id) : Subscription(id) {}
    bool registerCallback()
    {
        return true;
    }
};
template <typename Message> class Publication
{
public:
    explicit Publication(standin::Id) {}
    bool publish(const Message &message)
    {
        standin::Topic<Message>::message = message;
        standin::Topic<Message>::given = true;
        return true;
    }
};
} // namespace uORB
